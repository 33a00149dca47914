#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
"""Each check passes a sound tree and finds the mistake planted in it."""

import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import check_tree  # noqa: E402

SPDX = "// SPDX-FileCopyrightText: 2026 The rhview authors\n// SPDX-License-Identifier: MIT\n"
SPDX_HASH = SPDX.replace("//", "#")

SOUND_TREE = {
    "CMakeLists.txt": "project(rhview)\n",
    "README.md": "# rhview\n\n```cpp\nint x = 1;\nif (x) {\n    return;\n}\n```\n```cpp\nint y = 1;\n```\n",
    "cmake/RhviewModule.cmake": SPDX_HASH + "set(RHVIEW_FLOOR_base 0)\nset(RHVIEW_FLOOR_frustum 1)\n"
                                            "set(RHVIEW_FLOOR_gl 4)\n",
    "base/CMakeLists.txt": "rhview_module(base)  # OpenGL is not for us\n",
    "base/README.md": "line\n" * 60,
    "base/include/rhview/base/box.h": SPDX + "/// OpenGL's GL_INT_2_10_10_10_REV, glClear(0), EGL\n",
    "base/src/box.cpp": SPDX + '#include "rhview/base/box.h"\n#include <glm/vec3.hpp>\n'
                               'auto a = glm::vec3(1);  /* gl::Executor\n vkCreate() */\n'
                               'int b = 1\'000;\nconst char* c = "glEnd(GL_NONE)";\nint globe(int glide);\n'
                               'const char* d = R"(eglInit(")";\n',
    "frustum/CMakeLists.txt": "rhview_module(frustum DEPENDS base)\n",
    "frustum/README.md": "# frustum\n",
    "frustum/src/planes.cpp": SPDX + '#include "rhview/base/box.h"\n// #include "rhview/gl/executor.h"\n',
    "gl/CMakeLists.txt": "find_package(OpenGL)\nrhview_module(gl DEPENDS base frustum)\n",
    "gl/README.md": "# gl\n",
    "gl/src/draw.cpp": SPDX + "#include <epoxy/gl.h>\nvoid draw() { glClear(GL_COLOR_BUFFER_BIT); }\n",
    "samples/minimal/main.cpp": SPDX + "void f() {\n    // [snippet]\n    int x = 1;\n    if (x) {\n        return;\n"
                                       "    }\n    // [/snippet]\n}\n",
    "samples/engine_loop/main.cpp": SPDX + "// [snippet]\nint y = 1;\n// [/snippet]\n",
    "tests/scenes_test.cpp": SPDX + '#define FOLDER "../shared/scenes"\n',
    "build/generated.cpp": "glClear(0) without a licence, ../shared\n",
    "headers.txt": "base/include/rhview/base/box.h\n",
}

# check, path, text of the file (None: deleted), what the report must say
PLANTED = [
    ("graphics_api", "base/src/x.cpp", "#include <epoxy/gl.h>\n", "base/src/x.cpp:1: 'epoxy/gl.h'"),
    ("graphics_api", "base/src/x.cpp", "\n# include <GL/gl.h>\n", "base/src/x.cpp:2: 'GL/gl.h'"),
    ("graphics_api", "base/src/x.cpp", "#include <EGL/egl.h>\n", "'EGL/egl.h'"),
    ("graphics_api", "base/src/x.cpp", "#include <GLFW/glfw3.h>\n", "'GLFW/glfw3.h'"),
    ("graphics_api", "base/src/x.cpp", "#include <vulkan/vulkan.h>\n", "'vulkan/vulkan.h'"),
    ("graphics_api", "base/src/x.cpp", "#include <d3d12.h>\n", "'d3d12.h'"),
    ("graphics_api", "frustum/src/x.cpp", '#include "rhview/gl/executor.h"\n', "'rhview/gl/executor.h'"),
    ("graphics_api", "scenes/src/x.cpp", "/* a\n b */ void f() { glDrawArrays (1, 2, 3); }\n",
     "scenes/src/x.cpp:2: 'glDrawArrays'"),
    ("graphics_api", "lod/src/x.h", "int a = GL_TRIANGLES;\n", "'GL_TRIANGLES'"),
    ("graphics_api", "pipeline/src/x.h", "GLuint buffer;\n", "'GLuint'"),
    ("graphics_api", "pipeline/src/x.h", "gl::Executor* executor;\n", "'gl'"),
    ("graphics_api", "rhoctree/src/x.h", 'const char* a = "\\"//"; EGLDisplay display;\n', "'EGLDisplay'"),
    ("graphics_api", "baselines/src/x.h", "VkDevice device;\n", "'VkDevice'"),
    ("graphics_api", "baselines/src/x.h", "ID3D12Device* device;\n", "'ID3D12Device'"),
    ("graphics_api", "base/src/x.h.in", "int a = GL_NONE;\n", "'GL_NONE'"),
    ("graphics_api", "base/src/x.vert", "#version 450\n", "base/src/x.vert: a shader outside gl"),
    ("graphics_api", "frustum/CMakeLists.txt", "rhview_module(frustum LIBRARIES PkgConfig::epoxy)\n", "'epoxy'"),
    ("includes", "base/src/x.cpp", '\n#include "rhview/frustum/planes.h"\n',
     "base/src/x.cpp:2: base may not include frustum"),
    ("includes", "frustum/include/x.h", "#include <rhview/gl/context.h>\n", "frustum may not include gl"),
    ("includes", "frustum/src/x.cpp", '#include "rhview/utils/string.h"\n', "frustum may not include utils"),
    ("readmes", "frustum/README.md", None, "frustum/README.md is missing"),
    ("readmes", "base/README.md", "line\n" * 61, "base/README.md has 61 lines, 60 are allowed"),
    ("spdx", "base/src/x.cpp", "int x;\n", "base/src/x.cpp: no 'SPDX-FileCopyrightText"),
    ("spdx", "scripts/x.sh", "#!/bin/sh\n# SPDX-FileCopyrightText: 2026 The rhview authors\n",
     "scripts/x.sh: no 'SPDX-License-Identifier: MIT'"),
    ("spdx", ".ci/run", "#!/bin/sh\n", ".ci/run: no 'SPDX-License-Identifier: MIT'"),
    ("shared_folder", "docs/scenes.md", "see\n../shared/scenes\n", "docs/scenes.md:2: '../shared'"),
    ("shared_folder", "cli/main.cpp", 'auto f = "../../shared";\n', "cli/main.cpp:1: '../shared'"),
    ("registered_headers", "base/include/rhview/base/x.h", "", "base/include/rhview/base/x.h: not among the HEADERS"),
    ("registered_headers", "headers.txt", "\n", "headers.txt names no header"),
    ("readme_snippet", "README.md", "```cpp\nint x = 2;\n```\n```cpp\nint y = 1;\n```\n",
     "differs from the [snippet] region of samples/minimal/main.cpp"),
    ("readme_snippet", "samples/engine_loop/main.cpp", "// [snippet]\nint y = 2;\n// [/snippet]\n",
     "differs from the [snippet] region of samples/engine_loop/main.cpp"),
    ("readme_snippet", "README.md", "no code\n", "README.md: 0 ```cpp blocks"),
    ("readme_snippet", "samples/minimal/main.cpp", "int main() {}\n", "found 0"),
]


class CheckTree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name, text in SOUND_TREE.items():
            self.write(name, text)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def run_check(self, check, root=None):
        arguments = [check, str(root or self.root)]
        if check == "registered_headers":
            arguments.append(str(self.root / "headers.txt"))
        output = io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
            status = check_tree.main(arguments)
        return status, output.getvalue()

    def test_a_sound_tree_passes_every_check(self):
        for check in check_tree.CHECKS.keys() - {"format"}:
            with self.subTest(check):
                self.assertEqual(self.run_check(check), (0, f"{check}: nothing wrong\n"))

    def test_every_check_but_the_format_has_a_planted_mistake(self):
        self.assertEqual({plant[0] for plant in PLANTED}, check_tree.CHECKS.keys() - {"format"})

    def test_a_folder_without_modules_is_refused(self):
        self.assertEqual(self.run_check("spdx", self.root / "base")[0], 2)


def add_planted_cases():
    for number, (check, path, text, report) in enumerate(PLANTED):
        def test(self, check=check, path=path, text=text, report=report):
            if text is None:
                (self.root / path).unlink()
            else:
                self.write(path, text)
            status, output = self.run_check(check)
            self.assertEqual(status, 1, output)
            self.assertIn(report, output)
        setattr(CheckTree, f"test_{check}_finds_plant_{number}", test)


add_planted_cases()

if __name__ == "__main__":
    unittest.main()
