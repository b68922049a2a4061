# What emscripten reads (--em-config): its own libraries, and the newest compiler of Debian 12.
import os
import shutil

EMSCRIPTEN_ROOT = '/usr/share/emscripten'
LLVM_ROOT = '/usr/bin'
LLVM_ADD_VERSION = '19'
CLANG_ADD_VERSION = '19'
BINARYEN_ROOT = '/usr'
NODE_JS = shutil.which('node')
FROZEN_CACHE = True  # the libraries that the package holds
os.environ.setdefault('NODE_PATH', '/usr/share/nodejs')  # where Debian has acorn: a node of others does not know
