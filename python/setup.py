"""Builds the compiled half with CMake, from the source tree that this folder is part of."""

import os
import pathlib
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).resolve().parent.parent
PARTS = "libs/core;libs/recorder;libs/query;libs/protocol;libs/server;libs/client;libs/analysis;python"


class CMakeBuild(build_ext):
    def build_extension(self, ext: Extension) -> None:
        target = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve()
        # A build folder of EMCA that is there already saves building everything again.
        ready = os.environ.get("EMCA_BUILD_DIR")
        build = pathlib.Path(ready or self.build_temp).resolve()
        if not ready:
            self.build(build)
        built = list((build / "python" / "emca").glob("_native.*.so"))
        if len(built) != 1:
            raise RuntimeError(f"{build} has no Python part: install pybind11 and numpy (scripts/install-deps.sh does) and build again")
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(built[0]), str(target))

    def build(self, folder: pathlib.Path) -> None:
        if not (SOURCE / "CMakeLists.txt").exists():
            raise RuntimeError(f"emca is built from EMCA's source tree, and {SOURCE} is none: run pip in a checkout")
        folder.mkdir(parents=True, exist_ok=True)
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
        subprocess.run(["cmake", "-S", str(SOURCE), "-B", str(folder), "-DCMAKE_BUILD_TYPE=Release", "-DEMCA_BUILD_TESTS=OFF",
                        "-DEMCA_BUILD_BENCH=OFF", f"-DEMCA_ONLY_PARTS={PARTS}", f"-DPython3_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", str(folder), "--target", "emca_python", "--parallel", jobs], check=True)


setup(ext_modules=[Extension("emca._native", sources=[])], cmdclass={"build_ext": CMakeBuild})
