# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""The types of the compiled part (_core.pyi), which are written by hand, against the module."""

import ast
import inspect
import re
import unittest
from pathlib import Path

import transillum
from transillum import _core

STUB = Path(transillum.__file__).with_name("_core.pyi")


def stub_names(body):
    """The public names that a module or class of the stub declares, each with its node."""
    names = {}
    for node in body:
        name = node.target.id if isinstance(node, ast.AnnAssign) else getattr(node, "name", "_")
        if not name.startswith("_") or name in ("__version__", "__len__", "__init__"):
            names[name] = node
    return names


def names_of(thing):
    """The public names of the module or of one of its classes."""
    own = vars(thing)
    return {name for name in own if not name.startswith("_")}


class Stubs(unittest.TestCase):
    def setUp(self):
        self.declared = stub_names(ast.parse(STUB.read_text()).body)

    def test_the_module_has_what_the_stub_declares_and_nothing_else(self):
        self.assertEqual(names_of(_core), {n for n in self.declared if not n.startswith("_")})

    def test_so_do_its_classes(self):
        classes = [n for n, node in self.declared.items() if isinstance(node, ast.ClassDef)]
        self.assertEqual(
            set(classes), {n for n in names_of(_core) if inspect.isclass(getattr(_core, n))}
        )
        for name in classes:
            with self.subTest(name):
                real, stub = getattr(_core, name), stub_names(self.declared[name].body)
                self.assertEqual(names_of(real), {n for n in stub if not n.startswith("_")})
                for member in names_of(real):
                    decorators = {d.id for d in stub[member].decorator_list}
                    self.assertEqual(
                        isinstance(vars(real)[member], property), "property" in decorators, member
                    )

    def test_functions_have_as_many_arguments(self):
        # pybind11 writes them into the first line of the documentation.
        for name, node in self.declared.items():
            if isinstance(node, ast.FunctionDef):
                line = getattr(_core, name).__doc__.split("\n")[0]
                self.assertEqual(
                    len(re.findall(r"arg\d+: ", line)), len(node.args.args), f"{name}: {line}"
                )


if __name__ == "__main__":
    unittest.main()
