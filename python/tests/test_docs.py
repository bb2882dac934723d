"""What docs/python.md shows runs, block after block, as a reader would type it."""

import contextlib
import inspect
import io
import os
import re
import tempfile
import unittest

import emca
from support import RENDER, SOURCE, ServedScene


def blocks(text):
    """(line, code) of each Python block."""
    for match in re.finditer(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        yield text.count("\n", 0, match.start(1)), match.group(1)


@unittest.skipUnless(RENDER, "the reference renderer is not built")
class Guide(unittest.TestCase):
    def test_every_block_runs(self):
        page = SOURCE / "docs" / "python.md"
        count, names = 0, {"__name__": "guide"}
        self.addCleanup(os.chdir, os.getcwd())
        with tempfile.TemporaryDirectory() as folder, ServedScene("firefly", "160x120", 8) as address:
            os.chdir(folder)
            for line, code in blocks(page.read_text(encoding="utf-8")):
                code = "\n" * line + code.replace("localhost:50013", address)
                printed = io.StringIO()
                with contextlib.redirect_stdout(printed):
                    exec(compile(code, str(page), "exec"), names)
                count += 1
            os.chdir(SOURCE)
        self.assertGreater(count, 10)
        self.assertEqual(names["trace"].verdict, "exact")
        self.assertEqual(names["edge"].verdict, "exact")


class Documentation(unittest.TestCase):
    def test_everything_public_is_documented(self):
        missing = []
        for name in emca.__all__ + ["open", "ConnectionError", "TimeoutError"]:
            thing = getattr(emca, name)
            if not inspect.getdoc(thing):
                missing.append(name)
            if inspect.isclass(thing):
                missing += [f"{name}.{part}" for part, value in vars(thing).items() if not part.startswith("_")
                            and (inspect.isfunction(value) or isinstance(value, property)) and not inspect.getdoc(value)]
        self.assertEqual(missing, [])

    def test_types_are_shipped(self):
        folder = os.path.dirname(emca.__file__)
        for file in ("py.typed", "_native.pyi"):
            self.assertTrue(os.path.exists(os.path.join(folder, file)))
        with open(os.path.join(folder, "_native.pyi"), encoding="utf-8") as file:
            stub = file.read()
        compile(stub, "_native.pyi", "exec")
        from emca import _native
        for name, thing in vars(_native).items():
            if name.startswith("__") and name != "__version__":
                continue
            self.assertRegex(stub, rf"(?m)^(def {name}\(|class {name}:|{name}:)", name)
            if inspect.isclass(thing):
                body = re.search(rf"(?ms)^class {name}:.*?(?=^\S|\Z)", stub).group(0)
                for part in vars(thing):
                    if not part.startswith("_"):
                        self.assertRegex(body, rf"def {part}\(", f"{name}.{part}")


if __name__ == "__main__":
    unittest.main()
