"""pip installs the package from the source tree into a virtual environment, offline. The compiled half comes out of the build folder
that the tests belong to, so that it is not built twice."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["EMCA_SOURCE_DIR"])


def succeed(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


class Install(unittest.TestCase):
    def setUp(self):
        for package in ("pip", "setuptools", "wheel", "venv"):
            if subprocess.run([sys.executable, "-c", f"import {package}"], capture_output=True).returncode != 0:
                self.skipTest(f"{package} is not installed")

    def test_pip_in_a_virtual_environment(self):
        environment = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "PYTHONDONTWRITEBYTECODE")}
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            succeed(sys.executable, "-m", "venv", "--system-site-packages", folder / "venv", env=environment)
            python = folder / "venv" / "bin" / "python"
            # pip builds in the source tree; this copy keeps it clean.
            shutil.copytree(SOURCE / "python", folder / "python", ignore=shutil.ignore_patterns("build", "*.egg-info"))
            environment["EMCA_BUILD_DIR"] = os.environ["EMCA_BUILD_DIR"]
            succeed(python, "-m", "pip", "install", "--no-index", "--no-build-isolation", "--quiet", folder / "python", env=environment)
            said = succeed(python, "-c", "import emca, numpy; print(emca.__file__); print(emca.__version__, len(emca.PathSet()))",
                           cwd=folder, env=environment)
            self.assertTrue(said.startswith(str(folder / "venv")), said)
            installed = pathlib.Path(said.splitlines()[0]).parent
            for file in ("py.typed", "_native.pyi"):
                self.assertTrue((installed / file).exists(), file)
            listed = succeed(python, "-m", "pip", "list", "--format=freeze", env=environment)
            self.assertIn("emca==", listed)


if __name__ == "__main__":
    unittest.main()
