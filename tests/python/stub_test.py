# SPDX-FileCopyrightText: The Credo Authors
# SPDX-License-Identifier: Apache-2.0
"""The stubs, the docstrings and the modules say the same: every public name, every signature."""
import ast
import doctest
import inspect
import pathlib
import re
import unittest

import credo
from credo import evidence

FOLDER = pathlib.Path(credo.__file__).parent / "evidence"
STUBS = {module: ast.parse((FOLDER / name).read_text(encoding="utf-8"))
         for module, name in ((evidence, "__init__.pyi"), (evidence.batch, "batch.pyi"))}


def members(nodes):
    """Name -> the first definition of every class, function, module and public variable."""
    found = {}
    for node in nodes:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            found.setdefault(node.name, node)
        elif isinstance(node, ast.AnnAssign):
            found[node.target.id] = node
        elif isinstance(node, ast.ImportFrom):
            found |= {alias.asname: node for alias in node.names if alias.asname == alias.name}
    return found


def decorators(function):
    return {decorator.id for decorator in function.decorator_list}


def signature_in_stub(function):
    """(name, default or "required" or "many") of every parameter."""
    arguments = function.args
    names = [argument.arg for argument in arguments.posonlyargs + arguments.args]
    defaults = ["required"] * (len(names) - len(arguments.defaults)) + list(map(ast.literal_eval, arguments.defaults))
    parameters = list(zip(names, defaults))
    if arguments.vararg:
        parameters.append((arguments.vararg.arg, "many"))
    for argument, default in zip(arguments.kwonlyargs, arguments.kw_defaults):
        parameters.append((argument.arg, ast.literal_eval(default)))
    return parameters


def signature_in_docstring(function):
    return [(p.name, "many" if p.kind == p.VAR_POSITIONAL else "required" if p.default is p.empty else p.default)
            for p in inspect.signature(function).parameters.values()]


def signature_in_binding(function):
    """As a call with an argument that there never is tells."""
    try:
        function(**{"no such": None})
    except TypeError as error:
        said = re.search(r"^    1\. [\w.]*\((.*)\)(?: -> .*)?$", str(error), re.M).group(1)
    arguments = ast.parse("def f(" + re.sub(r"credo::evidence::", "", said) + "): ...").body[0]
    return signature_in_stub(arguments)


def without_names_of_many(parameters):
    return [("*", default) if default == "many" else (name, default) for name, default in parameters]


def definitions():
    """(module, name, definition in the stub) of all that has one."""
    for module, stub in STUBS.items():
        for name, node in members(stub.body).items():
            yield module, name, node


def classes():
    """(name, class, definitions of its members in the stub)."""
    for module, name, node in definitions():
        if isinstance(node, ast.ClassDef):
            yield name, getattr(module, name), members(node.body)


class StubTest(unittest.TestCase):
    def test_names_are_those_of_the_module(self):
        for module, stub in STUBS.items():
            public = {name for name in vars(module) if not name.startswith("_")}
            self.assertEqual(set(members(stub.body)) - {"__version__"}, public)

    def test_members_are_those_of_the_classes(self):
        implied = {"__module__", "__doc__", "__init__", "__getstate__", "__setstate__", "__repr__", "__str__"}
        for name, there, said in classes():
            found = {key for key, value in vars(there).items()
                     if key not in implied and not (key == "__hash__" and value is None)}
            self.assertEqual(set(said) - {"__init__"}, found, name)

    def test_kinds_of_members_agree(self):
        for name, there, said in classes():
            for key, member in said.items():
                static = inspect.getattr_static(there, key)
                self.assertEqual("property" in decorators(member), isinstance(static, property), (name, key))
                self.assertEqual("staticmethod" in decorators(member), isinstance(static, staticmethod), (name, key))

    def functions(self):
        """(what, definition in the stub, function) of all that is called by name."""
        for module, name, node in definitions():
            if isinstance(node, ast.FunctionDef):
                yield f"{module.__name__}.{name}", node, getattr(module, name)
        for name, there, said in classes():
            for key, member in said.items():
                if "property" not in decorators(member) and (key in ("__init__", "__call__") or key[0] != "_"):
                    yield f"{name}.{key}", member, getattr(there, key)

    def test_docstrings_have_the_signatures_of_the_stub(self):
        for what, node, function in self.functions():
            with self.subTest(what):
                self.assertEqual(signature_in_docstring(function), signature_in_stub(node))

    def test_the_module_takes_the_arguments_of_the_stub(self):
        for what, node, function in self.functions():
            if what.endswith("__init__"):
                function = getattr(evidence, what.split(".")[0])
            with self.subTest(what):
                expected = without_names_of_many(signature_in_stub(node))
                if what.endswith("__init__"):
                    expected = expected[1:]  # self
                self.assertEqual(without_names_of_many(signature_in_binding(function)), expected)

    def test_everything_says_what_it_is(self):
        for what, _, function in self.functions():
            self.assertTrue((function.__doc__ or "").strip(), what)
        for name, there, said in classes():
            self.assertTrue((there.__doc__ or "").strip(), name)
            for key, member in said.items():
                if "property" in decorators(member):
                    self.assertTrue(there.__dict__[key].__doc__, (name, key))

    def test_every_rule_is_a_function(self):
        for name in evidence.rules():
            self.assertTrue(callable(getattr(evidence, name)), name)

    def test_examples_in_docstrings_say_what_they_show(self):
        for module, least in (evidence, 20), (evidence.batch, 5):
            result = doctest.testmod(module)
            self.assertEqual(result.failed, 0)
            self.assertGreater(result.attempted, least)


if __name__ == "__main__":
    unittest.main()
