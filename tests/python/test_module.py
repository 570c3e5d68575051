# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""The Python module: known answers, the same bits as the program, interruption, errors."""

import csv
import functools
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import xml.etree.ElementTree

import numpy as np
import transillum

CORNERS = [
    (0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)
]  # fmt: skip
# Counterclockwise seen from inside.
CUBE = [[0, 1, 2, 3], [4, 7, 6, 5], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]]


def room(**options):
    return transillum.load("cornell-box", patches=150, **options)


class Import(unittest.TestCase):
    def test_a_numpy_whose_arrays_would_be_misread_is_refused(self):
        code = (
            "import sys, types\n"
            "numpy = sys.modules['numpy'] = types.ModuleType('numpy')\n"
            "numpy.__version__ = '2.4.6'\n"
            "sys.path.insert(0, sys.argv[1])\n"
            "try:\n"
            "    import _core\n"
            "except ImportError as error:\n"
            "    print(error)"
        )
        folder = os.path.dirname(transillum._core.__file__)
        result = subprocess.run(
            [sys.executable, "-c", code, folder], capture_output=True, text=True, check=True
        )
        major, minor = map(int, transillum._core.pybind11_version.split("."))
        refused = "NumPy 2.4.6 wrongly" in result.stdout
        self.assertEqual(refused, (major, minor) < (2, 12), result.stdout)


class Pictures(unittest.TestCase):
    def test_a_furnace_is_two_everywhere(self):
        solution = transillum.solve(transillum.load("furnace"), directions=64)
        eye = solution.scene.center[0] + 0.05 * solution.scene.normal[0]
        target = eye + solution.scene.normal[0] + (0.1, 0.2, 0.3)
        pixels = transillum.picture(solution, eye, target, size=(6, 4), samples=1)
        self.assertEqual((pixels.shape, pixels.dtype), ((4, 6, 3), np.float32))
        np.testing.assert_allclose(pixels, 2 / np.pi, rtol=1e-3)

    def test_a_picture_has_the_bits_of_the_program(self):
        solution = transillum.solve(room(), directions=64)
        eye, target = (0.278, 0.273, 0.05), (0.278, 0.2, 0.5)
        pixels = transillum.picture(solution, eye, target, up=(0, 1, 0), size=(8, 6), fov=60)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "p.pfm")
            command = "picture cornell-box --patches 150 -m 64 --eye 0.278,0.273,0.05 "
            command += "--target 0.278,0.2,0.5 --camera-up 0,1,0 --size 8x6 --fov 60 -q --out"
            subprocess.run([os.environ["TRANSILLUM_PROGRAM"], *command.split(), path], check=True)
            with open(path, "rb") as file:
                data = file.read()
        np.testing.assert_array_equal(
            pixels[::-1].ravel(), np.frombuffer(data[-4 * pixels.size :], dtype="<f4")
        )

    def test_wrong_values_are_named(self):
        solution = transillum.solve(room(), directions=8)
        with self.assertRaisesRegex(transillum.InputError, "eye: expected three numbers"):
            transillum.picture(solution, (1, 2))
        with self.assertRaisesRegex(transillum.InputError, "width in pixels is 0"):
            transillum.picture(solution, (0.278, 0.273, 0.05), size=(0, 4))


class Scenes(unittest.TestCase):
    def test_arrays_of_a_cube(self):
        cube = transillum.Scene(CORNERS, CUBE, reflectance=[0.1, 0.2, 0.3], exitance=2)
        self.assertEqual(len(cube), 6)
        np.testing.assert_array_equal(cube.points[cube.outlines[1]], np.array(CORNERS)[CUBE[1]])
        np.testing.assert_array_equal(cube.area, np.ones(6))
        np.testing.assert_array_equal(cube.normal[0], (0, 0, 1))
        np.testing.assert_array_equal(cube.center[1], (0.5, 0.5, 1))
        np.testing.assert_array_equal(cube.reflectance, np.tile((0.1, 0.2, 0.3), (6, 1)))
        np.testing.assert_array_equal(cube.exitance, np.full((6, 3), 2))

    def test_values_for_each_face(self):
        rho = np.linspace(0.1, 0.6, 6)
        light = np.arange(18.0).reshape(6, 3)
        cube = transillum.Scene(CORNERS, CUBE, rho, light, patches=100)
        self.assertGreater(len(cube), 50)
        np.testing.assert_array_equal(cube.reflectance[:, 1], rho[cube.face])
        np.testing.assert_array_equal(cube.exitance, light[cube.face])
        self.assertAlmostEqual(cube.area.sum(), 6, 12)

    def test_two_sided_faces_are_two_patches(self):
        self.assertEqual(len(transillum.Scene(CORNERS, CUBE, two_sided=True)), 12)

    def test_changing_an_array_changes_no_scene(self):
        cube = transillum.Scene(CORNERS, CUBE)
        before = cube.points
        cube.points[:] = 7
        np.testing.assert_array_equal(cube.points, before)

    def test_repairs_are_warnings(self):
        with self.assertWarns(transillum.TransillumWarning):
            transillum.Scene(CORNERS, CUBE + [[0, 1, 1]])

    def test_built_in_scenes_load(self):
        for name, summary in transillum.built_in_scenes().items():
            self.assertGreater(len(transillum.load(name)), 5)
            self.assertGreater(len(summary), 10)


class Solves(unittest.TestCase):
    def test_furnace(self):
        cube = transillum.Scene(CORNERS, CUBE, reflectance=0.5, exitance=1, patches=150)
        solution = transillum.solve(cube, directions=32, normalize="rows", tolerance=1e-12)
        self.assertTrue(solution.complete)
        np.testing.assert_allclose(solution.radiosity, 2, rtol=1e-10)
        np.testing.assert_allclose(solution.irradiance, 2, rtol=1e-10)

    def test_same_bits_as_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "result.csv")
            subprocess.run(
                [os.environ["TRANSILLUM_PROGRAM"], "solve", "cornell-box", "-m", "64",
                 "--out", path],
                check=True, stderr=subprocess.DEVNULL,
            )  # fmt: skip
            with open(path, newline="") as file:
                rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        names = [name for name in rows[0] if name.startswith("B_")]
        self.assertEqual(len(names), 3)
        expected = np.array([[float(row[name]) for name in names] for row in rows])
        solution = transillum.solve(transillum.load("cornell-box"), directions=64)
        np.testing.assert_array_equal(solution.radiosity, expected)

    def test_steps_end_with_the_same_bits(self):
        scene = room()
        whole = transillum.solve(scene, directions=24)
        run = transillum.Run(scene, directions=24)
        self.assertTrue(run.advance("direction"))
        self.assertEqual(run.progress["direction"], 1)
        self.assertEqual(run.radiosity.shape, (len(scene), 3))
        self.assertEqual(run.directions.shape, (24, 3))
        self.assertTrue(run.advance("iteration"))
        self.assertEqual(run.progress["iteration"], 1)
        self.assertFalse(run.advance("finished"))
        np.testing.assert_array_equal(run.solution().radiosity, whole.radiosity)

    def test_steps_of_an_accuracy_and_of_lobes_end_with_the_same_bits(self):
        for options in ({"accuracy": "5%"}, {"directions": 24, "glossy": True}):
            scene = room()
            run = transillum.Run(scene, **options)
            passes = 0
            while run.advance("direction"):
                passes += 1
                self.assertEqual(run.radiosity.shape, (len(scene), 3))
            self.assertGreater(passes, 24)
            whole = transillum.solve(scene, **options)
            np.testing.assert_array_equal(run.solution().radiosity, whole.radiosity)

    def test_error_estimate(self):
        scene = room()
        self.assertIsNone(transillum.solve(scene, directions=16).standard_error)
        solution = transillum.solve(scene, directions=256, replicas=8)
        exact = transillum.solve(scene, directions=4096).radiosity
        within = np.abs(solution.radiosity - exact) <= solution.confidence
        self.assertGreater(within.mean(), 0.85)
        rms = np.sqrt(((solution.radiosity - exact) ** 2).mean() / (exact**2).mean())
        self.assertLess(rms, solution.rms_error)

    def test_accuracy(self):
        solution = transillum.solve(room(), accuracy="5%")
        self.assertLessEqual(solution.rms_error, 0.05)
        self.assertTrue(solution.accuracy["reached"])
        worst = solution.accuracy["surface"]
        errors = solution.surface_errors
        self.assertEqual(errors[worst], max(errors.values()))
        self.assertLessEqual(errors[worst], solution.accuracy["error"])
        self.assertLessEqual(solution.accuracy["error"], 0.05)
        self.assertIsNone(solution.accuracy["obstacle"])
        missed = transillum.solve(room(), accuracy="0.001%", first_shot="none", most_passes=100)
        self.assertEqual(missed.accuracy["obstacle"], "passes")
        self.assertIsNone(transillum.solve(room(), directions=16).accuracy)
        self.assertIsNone(transillum.solve(room(), directions=16).surface_errors)

    def test_a_small_lamp_is_no_measure(self):
        data = os.path.join(os.path.dirname(__file__), "..", "..", "data")
        scene = transillum.load(os.path.join(data, "corpus", "small-lamp.obj"))
        truth = transillum.solve(scene, engine="pairs").radiosity[:6]
        plain = transillum.solve(scene)
        self.assertTrue(plain.statistics["converged"])
        self.assertLess(np.abs(plain.radiosity[:6] / truth - 1).max(), 0.01)
        accurate = transillum.solve(scene, accuracy="1%")
        self.assertLess(np.abs(accurate.radiosity[:6] / truth - 1).max(), 0.02)

    def test_an_accuracy_shoots_small_lamps_first_as_the_program_does(self):
        scene = room()
        for options, shot in (({}, True), ({"first_shot": "none"}, False)):
            solution = transillum.solve(scene, accuracy="0.5%", **options)
            self.assertEqual(solution.statistics["shot_sources"] > 0, shot)

    def test_linear_functions(self):
        scene = room()
        constant = transillum.solve(scene, directions=64)
        self.assertEqual(len(constant.corner_radiosity), len(scene))
        for corners, b in zip(constant.corner_radiosity, constant.radiosity):
            np.testing.assert_array_equal(corners, np.tile(b, (len(corners), 1)))
        linear = transillum.solve(scene, directions=64, basis="linear")
        for corners, outline in zip(linear.corner_radiosity, scene.outlines):
            self.assertEqual(corners.shape, (len(outline), 3))
        # The mean over a parallelogram is the mean over its corners.
        four = [i for i, outline in enumerate(scene.outlines) if len(outline) == 4]
        means = np.array([linear.corner_radiosity[i].mean(axis=0) for i in four])
        scale = np.abs(linear.radiosity).max()
        close = np.abs(means - linear.radiosity[four]).max(axis=1) < 1e-9 * scale
        self.assertGreater(close.mean(), 0.5)
        slopes = [np.ptp(linear.corner_radiosity[i]) for i in four]
        self.assertGreater(max(slopes), 0.01 * scale)

    def test_sky(self):
        floor = transillum.Scene(CORNERS[:4], [[0, 1, 2, 3]], reflectance=0.5)
        for sky, expected in ((10, [5, 5, 5]), ((2, 4, 6), [1, 2, 3])):
            solution = transillum.solve(floor, directions=64, normalize="rows", sky=sky)
            np.testing.assert_allclose(solution.radiosity, [expected], rtol=1e-12)


class FormFactors(unittest.TestCase):
    def test_meaning_reciprocity_and_closure(self):
        scene = room()
        f = transillum.form_factors(scene, directions=512, normalize="symmetric")
        flow = f.multiply(scene.area[:, None])
        self.assertLess(abs(flow - flow.T).max(), 1e-15)
        np.testing.assert_allclose(f.sum(axis=1), 1, atol=1e-8)
        # A small patch sends a larger fraction of its light to larger ones than it gets of theirs.
        small = int(scene.area.argmin())
        others = scene.area > 1.5 * scene.area[small]
        sent = np.asarray(f[small].todense())[0, others].sum()
        received = np.asarray(f[:, [small]].todense())[others, 0].sum()
        self.assertTrue(others.any())
        self.assertGreater(sent, received)

    def test_they_solve_the_scene(self):
        scene = room()
        options = {"directions": 128, "normalize": "rows"}
        f = transillum.form_factors(scene, **options)
        options["first_shot"] = "none"
        b = scene.exitance
        for _ in range(200):
            b = scene.exitance + scene.reflectance * (f @ b)
        expected = transillum.solve(scene, tolerance=1e-13, **options).radiosity
        np.testing.assert_allclose(b, expected, rtol=0, atol=1e-10 * expected.max())

    def test_of_a_run(self):
        scene = room()
        run = transillum.Run(scene, directions=32)
        run.advance("iteration")
        difference = run.form_factors() - transillum.form_factors(scene, directions=32)
        self.assertEqual(difference.nnz, 0)

    def test_parallel_squares(self):
        # Two unit squares, one apart (a closed form; Howell, C-11).
        two = transillum.Scene(
            CORNERS, [[0, 1, 2, 3], [4, 7, 6, 5]], reflectance=0.5, exitance=1
        )
        for options, tolerance in (({"directions": 20000}, 1e-3), ({"engine": "pairs"}, 1e-6)):
            f = transillum.form_factors(two, **options)
            self.assertAlmostEqual(f[0, 1], 0.19982489569838746, delta=tolerance)


class Visibility(unittest.TestCase):
    def test_engines_agree(self):
        scene = room()
        fast, local = (
            transillum.transfers(scene, (0.3, -0.5, 0.8), engine=engine)
            for engine in ("fast", "local")
        )
        areas = np.zeros((2, len(scene), len(scene)))
        for area, found in zip(areas, (fast, local)):
            area[found.receiver, found.source] = found.area
        self.assertGreater(areas.sum(), 0.1)
        np.testing.assert_allclose(areas[0], areas[1], rtol=0, atol=1e-12)
        self.assertLess(fast.closure_defect, 1e-10)
        projected, covered = fast.forward
        np.testing.assert_allclose(covered, projected, atol=1e-12)
        omega = np.array(fast.direction)
        cosine = np.maximum(scene.normal @ omega, 0)
        np.testing.assert_allclose(projected, scene.area * cosine, atol=1e-12)

    def test_the_length_of_a_direction_does_not_count(self):
        scene = room()
        direction = np.array((0.3, -0.5, 0.8))
        expected = transillum.transfers(scene, direction)
        self.assertGreater(len(expected.area), 10)
        # Powers of two change no digit; squares of their numbers overflow and underflow.
        for scale in (2.0**600, 2.0**-600, 2.0**1000, 2.0**-1000):
            found = transillum.transfers(scene, scale * direction)
            self.assertEqual(found.direction, expected.direction)
            np.testing.assert_array_equal(found.area, expected.area)
        tiny = transillum.transfers(scene, (1e-160, 2e-160, 3e-160))
        np.testing.assert_allclose(np.array(tiny.direction), np.array((1, 2, 3)) / 14**0.5)

    def test_a_map_adds_up(self):
        scene = room()
        omega = np.array((0.2, 0.1, 1))
        omega /= np.linalg.norm(omega)
        floor = int((scene.area * (scene.normal @ omega)).argmax())
        seen = transillum.visibility_map(scene, omega, floor)
        total = 0
        for polygon in seen.polygons:
            x, y = polygon.corners.T
            area = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2
            self.assertAlmostEqual(area, polygon.area, 12)
            total += area
        self.assertAlmostEqual(total, scene.area[floor] * (scene.normal[floor] @ omega), 12)

    def test_a_map_draws_itself(self):
        drawing = transillum.visibility_map(room(), (0, 0.3, 1))
        root = xml.etree.ElementTree.fromstring(drawing._repr_svg_())
        self.assertTrue(root.tag.endswith("svg"))
        self.assertGreater(len(root.findall(".//{*}path")), 10)


class Errors(unittest.TestCase):
    def test_wrong_values(self):
        scene = room()
        cases = {
            'did you mean "directions"': lambda: transillum.solve(scene, direction=3),
            'directions: "x" is not a whole number': lambda: transillum.solve(scene, directions="x"),
            "resolution is used only": lambda: transillum.solve(scene, resolution=5),
            "no such file": lambda: transillum.load("nothing.obj"),
            'did you mean "cornell-box"': lambda: transillum.load("cornel-box"),
            "not all 0": lambda: transillum.transfers(scene, (0, 0, 0)),
            "three finite numbers": lambda: transillum.transfers(scene, (0, np.nan, 1)),
            "three numbers": lambda: transillum.transfers(scene, (0, 1)),
            "direction: expected three": lambda: transillum.transfers(scene, [[0], [0], [1]]),
            "up: expected a direction": lambda: transillum.solve(
                scene, sky=1, sky_model="cie-overcast", up=[[0, 0, 1]]
            ),
            "directions: expected a number, not True": lambda: transillum.solve(
                scene, directions=True
            ),
            "tolerance: expected": lambda: transillum.solve(scene, tolerance=np.True_),
            "sky: expected one number or three, W/m2, or None, not True": lambda: transillum.solve(
                scene, sky=True
            ),
            "one_way: expected": lambda: transillum.solve(scene, one_way=1),
            "face 1 is [0, 1.5, 2], not integers": lambda: transillum.Scene(
                CORNERS, [[0, 1, 2], [0, 1.5, 2]]
            ),
            "face 0 is [0, True, 2]": lambda: transillum.Scene(CORNERS, [[0, True, 2]]),
            "face 0 is '012'": lambda: transillum.Scene(CORNERS, ["012"]),
            "exitance: expected": lambda: transillum.Scene(
                CORNERS, CUBE, exitance=[[1], [2], [3]]
            ),
            "the size of the picture is 0 pixels": lambda: transillum.visibility_map(
                scene, (0, 0, 1)
            ).svg(0),
            "the size of the picture is -5 pixels, but must be from 200": lambda: (
                transillum.visibility_map(scene, (0, 0, 1)).svg(-5)
            ),
            "no patch 9999": lambda: transillum.visibility_map(scene, (0, 0, 1), 9999),
            "out of range": lambda: transillum.Scene(CORNERS[:1], [[0, 1, 2]]),
            "(n, 3)": lambda: transillum.Scene([[0, 0]], []),
            "reflectance": lambda: transillum.Scene(CORNERS, CUBE, reflectance=[1, 2]),
            "engine pairs has no directions": lambda: transillum.Run(scene, engine="pairs"),
            "not an option of form_factors()": lambda: transillum.form_factors(scene, accuracy=0.1),
            "not an option of transfers()": lambda: transillum.transfers(
                scene, (0, 0, 1), directions=5
            ),
            'memory: "lots" is not a size': lambda: transillum.solve(scene, memory="lots"),
            "one_way: expected True or False": lambda: transillum.solve(scene, one_way="yes"),
            "neither": lambda: transillum.Run(scene).advance("end"),
            "nothing emits light, so B would be 0 everywhere": lambda: transillum.solve(
                transillum.Scene(CORNERS, CUBE, reflectance=0.5)
            ),
        }
        for message, call in cases.items():
            with self.subTest(message):
                with self.assertRaisesRegex(ValueError, re.escape(message)) as caught:
                    call()
                self.assertIsInstance(caught.exception, transillum.InputError)

    def test_booleans_are_no_numbers(self):
        scene = room()
        solution = transillum.solve(scene, directions=4, iterations=1)
        eye = (0.5, 0.5, 0.5)
        picture = functools.partial(transillum.picture, solution, eye)
        cases = {
            "patches": lambda: transillum.load("furnace", patches=True),
            "max_patch_area": lambda: transillum.load("furnace", max_patch_area=np.True_),
            "scale": lambda: transillum.load("furnace", scale=True),
            "default_reflectance": lambda: transillum.load("furnace", default_reflectance=False),
            "points": lambda: transillum.Scene([(0, 0, True)], []),
            "reflectance": lambda: transillum.Scene(CORNERS, CUBE, reflectance=False),
            "exitance": lambda: transillum.Scene(CORNERS, CUBE, exitance=np.ones(6, dtype=bool)),
            "direction": lambda: transillum.transfers(scene, (0, 0, True)),
            "patch": lambda: transillum.visibility_map(scene, (0, 0, 1), True),
            "size": lambda: transillum.visibility_map(scene, (0, 0, 1)).svg(True),
            "eye": lambda: transillum.picture(solution, (True, 0, 0)),
            "target": lambda: picture((0, True, 0)),
            "up": lambda: picture(up=(False, 0, 1)),
            "fov": lambda: picture(fov=True),
            "samples": lambda: picture(samples=True),
            "gather": lambda: picture(gather=False),
        }
        for name, call in cases.items():
            with self.subTest(name):
                with self.assertRaisesRegex(TypeError, f"^{name}: expected a number, not "):
                    call()
        with self.assertRaisesRegex(TypeError, "size: expected a number"):
            picture(size=(True, 4))

    def test_every_option_has_a_description(self):
        options = transillum.options()
        for name in ("directions", "one_way", "first_shot", "accuracy", "sky", "threads"):
            self.assertIn("default:", options[name])

    def test_what_progress_raises_ends_the_solve(self):
        def fail(progress):
            self.assertEqual(progress["passes"], 10**5)
            raise ZeroDivisionError

        with self.assertRaises(ZeroDivisionError):
            transillum.solve(room(), directions=10**5, progress=fail)

    def test_interruption_pauses_a_run(self):
        # The signal may be ignored, like in programs that a shell has started in the background.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before)
        run = transillum.Run(room(), directions=10**5)

        def press(progress):
            os.kill(os.getpid(), signal.SIGINT)

        with self.assertRaises(KeyboardInterrupt):
            run.advance("finished", progress=press)
        made = run.progress["direction"]
        self.assertGreater(made, 0)
        self.assertTrue(run.advance("direction"))
        self.assertEqual(run.progress["direction"], made + 1)

    def test_a_run_is_not_read_while_it_works(self):
        run = transillum.Run(room(), directions=10**5)

        def look(progress):
            with self.assertRaises(RuntimeError):
                run.radiosity
            raise ZeroDivisionError

        with self.assertRaises(ZeroDivisionError):
            run.advance("finished", progress=look)
        self.assertEqual(run.radiosity.shape[1], 3)

    def test_other_threads_work_meanwhile(self):
        class Enough(Exception):
            pass

        count = 0
        stop = threading.Event()

        def work():
            nonlocal count
            while not stop.is_set():
                count += 1

        def look(progress):
            if count > 1000:
                raise Enough

        other = threading.Thread(target=work)
        other.start()
        try:
            with self.assertRaises(Enough):
                transillum.solve(room(), directions=10**5, progress=look)
        finally:
            stop.set()
            other.join()


try:
    import pyvista
except ImportError:
    pyvista = None


@unittest.skipUnless(pyvista, "PyVista is not installed")
class PyVista(unittest.TestCase):
    def test_there_and_back(self):
        scene = room()
        solution = transillum.solve(scene, directions=16, replicas=2)
        mesh = transillum.to_pyvista(solution)
        self.assertEqual(mesh.n_cells, len(scene))
        np.testing.assert_array_equal(mesh.cell_data["radiosity"], solution.radiosity)
        again = transillum.from_pyvista(mesh)
        np.testing.assert_allclose(again.area, scene.area, rtol=1e-12)
        np.testing.assert_array_equal(again.reflectance, scene.reflectance)
        np.testing.assert_array_equal(
            transillum.solve(again, directions=16, replicas=2).radiosity, solution.radiosity
        )


if __name__ == "__main__":
    unittest.main()
