"""Builds the extension module plumb._core by CMake, as pip asks for it. All else is in pyproject.toml."""

import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = pathlib.Path(__file__).resolve().parent


class ByCMake(build_ext):
    def build_extension(self, extension):
        build = pathlib.Path(self.build_temp).resolve()
        module = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        module.parent.mkdir(parents=True, exist_ok=True)
        run = [
            f"-DPython_EXECUTABLE={sys.executable}",
            "-DCMAKE_BUILD_TYPE=Release",
            f"-DCMAKE_LIBRARY_OUTPUT_DIRECTORY={module.parent}",
        ]
        subprocess.run(["cmake", "-S", HERE, "-B", build, *run], check=True)
        subprocess.run(["cmake", "--build", build, "--parallel"], check=True)


def version():
    """Of the interface, as its header says."""
    header = (HERE.parent / "include" / "plumb" / "types.h").read_text()
    return ".".join(re.search(r"define PLUMB_VERSION PLUMB_MAKE_VERSION\((\d+), (\d+)\)", header).groups())


setup(version=version(), ext_modules=[Extension("plumb._core", sources=[])], cmdclass={"build_ext": ByCMake})
