# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""The code for Python that the cookbook prints is run as it stands there."""

import re
import unittest
from pathlib import Path

import numpy as np


class Cookbook(unittest.TestCase):
    def test_python_code(self):
        text = (Path(__file__).parents[2] / "libtransillum/COOKBOOK.md").read_text()
        blocks = re.findall(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
        self.assertEqual(len(blocks), 1)
        names = {}
        exec(blocks[0], names)
        count = len(names["scene"])
        self.assertEqual(names["solution"].radiosity.shape, (count, 3))
        self.assertEqual(names["f"].shape, (count, count))
        np.testing.assert_allclose(names["f"].sum(axis=1), 1, atol=0.2)


if __name__ == "__main__":
    unittest.main()
