"""`holdfast report`: in which order layouts get a page, what stands on it, and what is refused."""
import re
import unittest
import xml.etree.ElementTree as ET

import h5py
import numpy as np

from cli import SOURCE, CliTest, datasets

LAYOUTS = SOURCE / "configs/layouts"
TRAILER = SOURCE / "configs/loads/trailer.csv"
PLANNER = SOURCE / "tests/io/loads/formats/planner_export.csv"
OF_LOADS = ("material_name", "box_name", "mass", "mat", "fixed", "order", "bearing_limit", "container_type", "container_size", "open_sides",
            "drop_sides", "bed_height")  # what layouts have since loads say more than places and sizes
SVG = "{http://www.w3.org/2000/svg}"
NOT_MODELLED = "Straps, air bags and stretch film are not modelled."


def made_older(path):
    """Turns a results file into one of version 2, which has nothing of what boxes did on the way."""
    with h5py.File(path, "r+") as file:
        file.attrs.modify("format_version", np.uint64(2))
        worlds, boxes = file["summary/worlds"], file["summary/boxes"]
        worlds["max_displacement"] = worlds["end_displacement"][:]
        worlds["verdict"][...] = np.where(file["worlds/stop_reason"][:] == 4, 5, worlds["verdict"][:])
        boxes["first_move_time"] = boxes["first_beyond"][:]
        for name in ("worlds/status_time", "worlds/caveats", "boxes/peak_drop", "boxes/peak_tilt", "boxes/first_beyond",
                     "margins/margin_within_limits", "margins/critical_box_within_limits"):
            del file[name]
        for group, names in ((worlds, ("critical_box", "fallen_at_end", "peak_drop", "peak_tilt", "end_displacement",
                                       "end_kinetic_energy")), (boxes, ("first_beyond", "fallen_at_end"))):
            for name in names:
                del group[name]


def made_trailer(path, **settings):
    """Turns a file of three boxes with open rear and roof into one of a trailer with low left and right sides whose third box
    is a bulkhead: the first box ends on the ground behind the rear, and the second beside the left side."""
    with h5py.File(path, "r+") as file:
        given = {"Container/DropSides": "left 60 right 60", "Container/BedHeight": "120", "Material 2/Fixed": "true", **settings}
        for key, value in given.items():
            file["inputs/settings"].attrs[key] = value
        moves = np.array([[3.0, 0, -1.2], [0, -1.5, -1.2], [0, 0, 0]])
        file["boxes/settling_displacement"][:] = 0
        file["boxes/end_displacement"][:] = moves
        file["boxes/peak_displacement"][:] = np.linalg.norm(moves, axis=1)
        first = [0.4, 0.5, np.nan]
        for name in ("boxes/first_beyond", "summary/boxes/first_beyond"):
            file[name][:] = first
        for name in ("fallen", "moved"):
            file[f"summary/boxes/{name}"][:] = [1, 1, 0]
        for name in ("tilted", "unstable"):
            file[f"summary/boxes/{name}"][:] = 0
        file["summary/worlds/verdict"][:] = 2
        file["summary/worlds/critical_box"][:] = 1


def views(text, wanted=("top", "side", "corner"), at_end=False):
    """The polygons of pictures of the load as it was packed, or at the end, as pairs of attributes and corners."""
    def corners(shape):
        return [tuple(map(float, point.split(","))) for point in shape.get("points").split()]

    pictures = pictures_of(text, at_end)
    return [[(shape.attrib, corners(shape)) for shape in pictures[view].iter(f"{SVG}polygon")] for view in wanted]


def pictures_of(text, at_end=False):
    """The pictures of the first load, by view: as it was packed, or at the end."""
    pictures = [ET.fromstring(svg) for svg in re.findall(r"<svg.*?</svg>", text)]
    return {picture.get("aria-label"): picture for picture in (pictures[5:7] if at_end else pictures[:5])}


class Report(CliTest):
    def screen(self, *arguments):
        self.assert_exit(self.run_here("screen", "--quiet", "--norm", "road", "--accuracy", "screening", *arguments), 0)

    def report(self, *arguments):
        done = self.run_here("report", "results.h5", *arguments)
        self.assert_exit(done, 0)
        return done.stdout, (self.folder / "report.html").read_text()

    def test_every_layout_has_a_page_those_that_fail_before_those_that_hold(self):
        self.screen("--layouts", LAYOUTS / "BR5_020_layer_h60.txt", LAYOUTS / "seed_example.txt", LAYOUTS / "BR8_009_ep.txt",
                    "--margins", "--walls", "en12642-l")
        data = datasets(self.folder / "results.h5")
        failing = {data["/inputs/layouts/name"][layout].decode() for layout, verdict
                   in zip(data["/worlds/layout"], data["/summary/worlds/verdict"]) if verdict != 0}
        self.assertEqual(failing, {"seed_example.txt", "BR8_009_ep.txt"})
        told, text = self.report()
        self.assertEqual(told, "report.html: 3 layouts\n")
        pages = re.findall(r"<h2>(.*?)</h2>", text)
        self.assertEqual(set(pages[:2]), failing)
        self.assertEqual(pages[2:], ["BR5_020_layer_h60.txt"])
        self.assertIn("2 of 3 layouts do not hold", text)

        seed = next(part for part in text.split("<section>") if "<h2>seed_example.txt" in part)
        # The margins of its documentation, in place and within limits, what the road needs, and a side that is too weak.
        self.assertIn("<td>right</td><td>0.27 g</td><td><span class=bad>0.27 g</span></td><td>0.5 g</td><td class=\"text name\">box 3</td>", seed)
        self.assertIn("<td>left</td><td>1.50+ g</td><td>1.50+ g</td><td>0.5 g</td><td class=\"text name\">-</td>", seed)
        self.assertRegex(seed, r"<td>front</td><td>[\d.]+ kN</td><td>[\d.]+ kN</td><td><span class=bad>\d+ %</span>")
        # One row per acceleration, each with its verdict.
        self.assertEqual(len(re.findall(r"<tr><td>road-", seed)), 4)
        self.assertEqual(text.count(NOT_MODELLED), 4)  # on the front page too

    def test_a_load_that_holds_is_told_with_all_that_a_page_to_file_needs(self):
        self.screen("--layouts", LAYOUTS / "BR5_020_layer_h60.txt", "--margins")
        told, text = self.report()
        self.assertEqual(told, "report.html: 1 layout\n")
        self.assertIn("The layout holds.", text)
        self.assertIn("<td>BR5_020_layer_h60.txt</td><td class=text>holds</td>", text)
        data = datasets(self.folder / "results.h5")
        page = text.split("<section>")[1]
        self.assertIn("<span class=good>holds under all 4 accelerations</span>.</p>", page)
        self.assertIn("<td class=text>road: EN 12195-1, road; Directive 2014/47/EU, Annex III</td>", page)
        self.assertRegex(page, r"<td>simulated</td><td class=text>holdfast \d\S*, native screening, 20\d\d-\d\d-\d\d \d\d:\d\d:\d\d UTC</td>")
        # The centre of gravity is that of the boxes, and told with what the CTU Code says of it.
        rows = slice(0, int(data["/worlds/box_count"][0]))
        mass = data["/boxes/mass"][rows]
        x, y, z = mass @ data["/boxes/initial_position"][rows] / mass.sum()
        where = f"{x:.2f} m from the front wall ({100 * x / 5.87:.0f} % of the length), {y:.2f} m from the left side, {z:.2f} m above the floor."
        verdict = "it does." if abs(x / 5.87 - 0.5) <= 0.05 else "it does not."
        self.assertIn(where, page)
        self.assertRegex(page, rf"It may lie from 2.64 m to 3.23 m from the front wall \(CTU Code 2014, Annex 7, 3.1.4\): {verdict}")
        self.assertEqual(re.findall(r"<tr><td>(road-\S+)</td><td class=text>(.*?)</td><td class=text>stayed", page),
                         [("road-front-0g8", "front 0.8 g"), ("road-rear-0g5", "rear 0.5 g"), ("road-left-0g5", "left 0.5 g"),
                          ("road-right-0g5", "right 0.5 g")])
        for name, hashed in zip(("front-0g8", "rear-0g5", "left-0g5", "right-0g5"), data["/worlds/state_hash"]):
            self.assertIn(f"road-{name} {int(hashed):016x}", page)
        # Boxes have their numbers in the drawings along an axis.
        pictures = pictures_of(page)
        for view in ("top", "side", "rear", "front"):
            self.assertGreater(len(list(pictures[view].iter(f"{SVG}text"))), 3, view)

    def test_a_norm_asks_for_margins_by_what_leaves_the_load_its_weight(self):
        self.assert_exit(self.run_here("screen", "--quiet", "--norm", "sea-a", "--accuracy", "screening", "--layouts",
                                       LAYOUTS / "seed_example.txt", "--margins"), 0)
        _, text = self.report()
        needed = re.findall(r"<tr><td>(front|rear|left|right)</td><td>[^<]*</td><td>.*?</td><td>(.*?)</td>", text)
        self.assertEqual(needed, [("front", "-"), ("rear", "-"), ("left", "0.5 g"), ("right", "0.5 g")])

    def test_the_way_of_the_boxes_is_told_and_the_end_beside_it(self):
        self.screen("--layouts", LAYOUTS / "BR15_077_ep.txt")
        _, text = self.report()
        data = datasets(self.folder / "results.h5")

        def centimetres(metres):
            """With as many digits as it takes to see on which side of the limit of 10 cm it is."""
            return next(told for told in (f"{100 * metres:.{digits}f}" for digits in range(4))
                        if (float(told) > 10) == (metres > 0.1))

        for world, name in enumerate(("road-front-0g8", "road-rear-0g5", "road-left-0g5", "road-right-0g5")):
            found = {key: data[f"/summary/worlds/{key}"][world] for key in
                     ("critical_box", "fallen_boxes", "fallen_at_end", "moved_boxes", "tilted_boxes", "peak_displacement",
                      "end_displacement")}
            first = data["/boxes/first_beyond"][int(data["/worlds/box_begin"][world]) + int(found["critical_box"]) - 1]
            self.assertIn(f"<td class=\"text name\">box {found['critical_box']}, {first:.2f} s</td><td>{found['fallen_boxes']} "
                          f"({found['fallen_at_end']})</td><td>{found['moved_boxes']}</td><td>{found['tilted_boxes']}</td><td>"
                          f"{centimetres(found['peak_displacement'])} ({centimetres(found['end_displacement'])})</td>", text, name)
        caveats = data["/worlds/caveats"].tolist()
        self.assertEqual(caveats, [0, 4, 4, 4])
        self.assertEqual(text.count("<td class=text>marginal</td>"), 3)
        self.assertIn("Marginal: a friction coefficient is within 2 %", text)

    def test_a_world_that_ended_early_is_at_least_its_verdict(self):
        self.screen("--layouts", LAYOUTS / "seed_example.txt", LAYOUTS / "unstable_BR2_007_bpjs.txt", "--stop-when", "moved")
        _, text = self.report()
        self.assertIn("road-front-0g8: at least moved", text)
        self.assertIn("road-front-0g8: unstable", text)
        self.assertNotIn("at least unstable", text)

    def test_a_load_that_is_unstable_goes_under_gravity_alone(self):
        self.write("hovers.txt", "1 1\n200 100 30 250 150 80 1\n")
        self.screen("--layouts", "hovers.txt")
        _, text = self.report()
        self.assertIn("<span class=bad>unstable</span></td><td class=\"text name\">box 1, settling</td>", text)
        self.assertIn("<td>30 (30)</td><td>30 (30)</td><td>0 (0)</td><td>settling</td><td class=text>gravity alone</td>", text)

    def test_a_file_of_an_earlier_version_is_judged_at_the_end(self):
        self.screen("--layouts", LAYOUTS / "seed_example.txt", "--margins", "--stop-when", "moved")
        made_older(self.folder / "results.h5")
        _, text = self.report()
        at_end = f"{NOT_MODELLED} The file is of an earlier version: its worlds are judged by where boxes are at the end"
        self.assertEqual(text.count(at_end), 2)
        self.assertIn("road-front-0g8: at least moved, road-rear-0g5: at least moved, road-right-0g5: at least moved", text)
        self.assertIn("<td>right</td><td><span class=bad>0.27 g</span></td><td>0.5 g</td><td class=\"text name\">box 3</td>", text)
        self.assertIn("tilted by 10°, at the end", text)
        with h5py.File(self.folder / "results.h5", "r+") as file:
            file["summary/worlds/fallen_boxes"][0] = 1
        _, text = self.report()
        self.assertIn("road-front-0g8: at least fell, road-rear-0g5: at least moved", text)

    def test_views_show_every_box_and_mark_the_first(self):
        self.write("boxes.txt", "1 3\n0 0 0 100 100 100 1\n0 0 100 40 100 200 1\n300 100 0 400 200 20 1\n")
        self.screen("--layouts", "boxes.txt")
        _, text = self.report()
        pictures = pictures_of(text)
        faces = {name: [p for p in view.iter(f"{SVG}polygon") if p.get("fill") != "none"] for name, view in pictures.items()}
        self.assertEqual({name: len(found) for name, found in faces.items()}, {"top": 3, "side": 3, "rear": 3, "front": 3, "corner": 9})

        def extent(face):
            points = [tuple(map(float, point.split(","))) for point in face.get("points").split()]
            return tuple(max(axis) - min(axis) for axis in zip(*points))

        scale = 250 / (2.33 + 2.2)  # pixels per metre of all of them, which a page has room for
        expected = {"top": [(0.4, 1), (1, 1), (1, 1)], "side": [(0.4, 1), (1, 0.2), (1, 1)], "rear": [(1, 0.2), (1, 1), (1, 1)]}
        expected["front"] = expected["rear"]
        for name, sizes in expected.items():
            # Pixels are told to a tenth, which is no order.
            for found, size in zip(sorted(map(extent, faces[name]), key=lambda pixels: [round(part / 5) for part in pixels]), sorted(sizes)):
                for a, b in zip(found, size):
                    self.assertAlmostEqual(a, b * scale, delta=0.11)
        # The tall box tips to the rear, and the flat one slides to the front; the one below stays.
        self.assertEqual({element.text for element in pictures["corner"].iter(f"{SVG}text")}, {"2", "3"})
        # The left side is on the left of whoever looks from the rear, and the rear is what he sees before the rest.
        middles = {view: {element.text: float(element.get("x")) for element in pictures[view].iter(f"{SVG}text")} for view in ("rear", "front")}
        self.assertLess(middles["rear"]["1"], middles["rear"]["3"])
        self.assertGreater(middles["front"]["1"], middles["front"]["3"])
        self.assertEqual(set(middles["rear"]), {"1", "2", "3"})

    def trailer(self, **settings):
        self.write("trailer.txt", "1 3\n460 20 0 560 120 100 1\n200 0 0 300 80 100 1\n0 0 0 10 233 150 2\n")
        self.write("front.txt", "0 1 -8 0 0\n")
        self.write("trailer.ini", "[Container]\nOpenSides = rear roof\n")
        done = self.run_here("screen", "--quiet", "-c", "trailer.ini", "--layouts", "trailer.txt", "--accelerations", "front.txt",
                             "--wall-forces", "--overwrite")
        self.assert_exit(done, 0)
        made_trailer(self.folder / "results.h5", **settings)
        return self.report()[1]

    def test_boxes_that_leave_are_told_with_their_way(self):
        text = self.trailer()
        self.assertIn("<td class=text>5.87 × 2.33 × 2.2 m; rear, roof open; left 60 cm high; right 60 cm high; floor 120 cm above the ground</td>", text)
        self.assertIn("<p>2 boxes of 450 kg, 6 % of the container's volume, and 1 fixed; <span class=bad>fails under 1 of 1 acceleration</span>.</p>", text)
        self.assertIn("<p>Under front.txt, box 1, which goes first, leaves through the open rear and 1 more leaves over the low left "
                      "side.</p>", text)
        rows = re.findall(r"<td class=text>front.txt</td><td class=text>(.*?)</td>", text)
        self.assertEqual(rows, ["rear", "left side"])  # the farthest first
        self.assertEqual(re.findall(r"<tr><td>([\w ]+)</td><td>[\d.]+ kN", text), ["front", "left", "right", "fixed boxes"])
        self.assertIn("fixed, part of the container", text)
        self.assertIn("from above the rear", text)
        # A wall up to the roof lets nothing over it.
        text = self.trailer(**{"Container/DropSides": "left 220", "Container/OpenSides": "rear"})
        self.assertIn("leaves through the open rear.</p>", text)
        self.assertNotIn("left side", text.replace("from the left side", ""))

    def test_a_box_that_tips_out_while_the_load_settles_leaves_under_gravity_alone(self):
        # The first box tips over the sill, beyond which its centre of mass is as loaded; the last one holds the third, whose centre of mass is, too.
        self.write("over.txt", "1 4\n560 10 0 640 60 40 1\n300 10 0 360 60 40 1\n540 100 0 646 160 20 1\n540 100 20 600 160 120 1\n")
        self.write("brake.txt", "0 1 2 0 0\n")
        self.write("left.txt", "0 1 0 2 0\n")
        self.write("open.ini", "[Container]\nOpenSides = rear\n")
        done = self.run_here("screen", "--quiet", "-c", "open.ini", "--layouts", "over.txt", "--accelerations", "brake.txt", "left.txt")
        self.assert_exit(done, 0)
        text = self.report()[1]
        self.assertEqual(re.findall(r"<p>Under .*?</p>", text), ["<p>Under gravity alone, box 1, which goes first, leaves through the open rear.</p>"])
        self.assertIn("<h3>At the end under gravity alone</h3>", text)
        self.assertIn("<td class=text>gravity alone</td><td class=text>rear</td></tr>", text)

    def test_the_force_on_fixed_boxes_stands_below_that_on_the_walls(self):
        self.trailer()
        with h5py.File(self.folder / "results.h5", "r+") as file:
            force = file["walls/lasting_force"][:]
            force[:, 7] = 8500
            file["walls/lasting_force"][:] = force
        row = "<tr><td>fixed boxes</td><td>8.5 kN</td><td>-</td><td>-</td><td class=text>front.txt</td></tr>"
        self.assertIn(row, self.report()[1])
        # A load without such boxes has no row of them, and neither has a file of an earlier version, whose last side is the roof.
        with h5py.File(self.folder / "results.h5", "r+") as file:
            file["inputs/settings"].attrs["Material 2/Fixed"] = "false"
        self.assertNotIn("fixed boxes", self.report()[1])
        with h5py.File(self.folder / "results.h5", "r+") as file:
            file["inputs/settings"].attrs["Material 2/Fixed"] = "true"
            for name in ("lasting_force", "limit"):
                six = file[f"walls/{name}"][:, :6]
                del file[f"walls/{name}"]
                file[f"walls/{name}"] = six
        text = self.report()[1]
        self.assertRegex(text, r"<tr><td>right</td><td>[\d.]+ kN")
        self.assertNotIn("fixed boxes", text)

    def test_views_show_walls_as_high_as_they_are_and_the_floor_on_the_ground(self):
        top, side, corner = views(self.trailer())
        scale = 250 / (2.33 + 3.4)  # pixels per metre, which is as high as a page has room for

        def height(corners):
            return max(y for _, y in corners) - min(y for _, y in corners)

        # From the side: the block of the floor, the front wall and the two low walls.
        block = [corners for attributes, corners in side if attributes["fill"] == "#cfd2d6"]
        self.assertEqual(len(block), 1)
        self.assertAlmostEqual(height(block[0]), 1.2 * scale, delta=0.2)
        walls = sorted(height(corners) / scale for attributes, corners in side if attributes["fill"] == "none")
        self.assertEqual([round(wall, 2) for wall in walls], [0.6, 0.6, 2.2])
        # From above: a floor whose border is dashed, and a line for each wall, of which the rear is none.
        self.assertEqual(sum("stroke-dasharray" in attributes for attributes, _ in top), 1)
        lines = [corners for attributes, corners in top if attributes["fill"] == "none"]
        self.assertEqual(len(lines), 3)
        self.assertFalse(any(min(x for x, _ in corners) > 5.8 * scale for corners in lines))
        # From the corner: ground, and the fixed box in its own colour, three faces of it.
        self.assertEqual(sum(attributes["fill"] == "#f3f4f6" for attributes, _ in corner), 1)
        self.assertEqual(sum(attributes["fill"] in ("#949da8", "#8a929c", "#7f8790") for attributes, _ in corner), 3)
        # A floor without end has no block and no ground, and what is closed is drawn as ever.
        _, side, corner = views(self.trailer(**{"Container/BedHeight": "0"}))
        self.assertFalse(any(attributes["fill"] in ("#cfd2d6", "#f3f4f6") for attributes, _ in side + corner))
        top, side, corner = views(self.trailer(**{"Container/OpenSides": "", "Container/DropSides": ""}))
        self.assertFalse(any("stroke-dasharray" in attributes for attributes, _ in top + side + corner))
        self.assertEqual([sum(attributes["fill"] == "none" for attributes, _ in view) for view in (top, side, corner)], [1, 1, 3])

    def test_boxes_on_the_ground_are_drawn_where_they_end(self):
        text = self.trailer()
        self.assertIn("<h3>At the end under front.txt</h3>", text)
        top, corner = views(text, ("top", "corner"), at_end=True)
        floor = next(corners for attributes, corners in top if "stroke-dasharray" in attributes)
        right, bottom = (max(corner[axis] for corner in floor) for axis in (0, 1))
        # From above: the first box lies behind the rear, the second beside the left side, and the bulkhead where it was.
        first, second = (next(corners for attributes, corners in top if attributes["fill"] == colour) for colour in ("#d9534f", "#f3c58b"))
        self.assertGreater(min(x for x, _ in first), right)
        self.assertGreater(min(y for _, y in second), bottom)
        self.assertEqual(sum(attributes["fill"] == "#949da8" for attributes, _ in top), 1)
        self.assertEqual(sum(attributes["fill"] in ("#d9534f", "#ca4d49", "#bb4744") for attributes, _ in corner), 3)
        width = max(x for _, corners in top for x, _ in corners)
        self.assertLess(width, 332, "all of it is in the picture")
        # Turned by 45 degrees about the vertical axis, a box of 1 m is 1.41 m wide.
        with h5py.File(self.folder / "results.h5", "r+") as file:
            file["series/orientation"][-3] = [np.cos(np.pi / 8), 0, 0, np.sin(np.pi / 8)]
        top, _ = views(self.report()[1], ("top", "corner"), at_end=True)
        turned = next(corners for attributes, corners in top if attributes["fill"] == "#d9534f")
        side = np.hypot(*np.subtract(turned[0], turned[1]))
        self.assertAlmostEqual(max(x for x, _ in turned) - min(x for x, _ in turned), side * np.sqrt(2), delta=0.3)
        # What lies farther away is told, and the rest is drawn as large as ever.
        with h5py.File(self.folder / "results.h5", "r+") as file:
            end = file["boxes/end_displacement"][:]
            end[0, 0] = 40.0
            file["boxes/end_displacement"][:] = end
        text = self.report()[1]
        self.assertIn("<p class=note>More than 5 m from the container, and not drawn: box 1.</p>", text)
        top, _ = views(text, ("top", "corner"), at_end=True)
        self.assertFalse(any(attributes["fill"] == "#d9534f" for attributes, _ in top))
        self.assertGreater(max(x for _, corners in top for x, _ in corners), 200)
        # A closed container lets nothing out, and without series nobody knows how boxes have turned.
        self.assertNotIn("At the end", self.trailer(**{"Container/OpenSides": "", "Container/DropSides": ""}))
        self.trailer()
        with h5py.File(self.folder / "results.h5", "r+") as file:
            file["worlds/sample_count"][:] = 0
        self.assertNotIn("At the end", self.report()[1])

    def test_numbers_and_words_read_well_whatever_they_are(self):
        self.write("one.txt", "1 1\n200 0 0 300.5 100 100 1\n")
        self.write("brake.txt", "0 1 8 0 0\n")
        self.run_here("screen", "--quiet", "--layouts", "one.txt", "--accelerations", "brake.txt", "--margins", "--walls", "en12642-l")
        with h5py.File(self.folder / "results.h5", "r+") as file:
            end = file["boxes/end_displacement"][:]
            end[:, 2] = 0.0
            file["boxes/end_displacement"][:] = end
            file["boxes/peak_drop"][:] = -0.0
            file["boxes/peak_tilt"][:] = 10.04
            file["boxes/first_beyond"][:] = np.nan
            file["summary/boxes/first_beyond"][:] = np.nan
            file["walls/lasting_force"][:, 1] = 1.002 * file["walls/limit"][:, 1]
        told, text = self.report()
        self.assertEqual(told, "report.html: 1 layout\n")
        self.assertIn("1 of 1 layout does not hold.", text)
        self.assertIn("<p>1 box of 251 kg, 3 % of the container's volume; <span class=bad>fails under 1 of 1 acceleration</span>.</p>", text)
        self.assertNotRegex(text, r"\b1 (layouts|boxes|accelerations|more boxes)\b")
        self.assertNotIn(">-0", text)
        self.assertIn("<td>0 (0)</td><td>10.04 (0)</td>", text)
        self.assertIn("<td class=\"text name\">box 1</td>", text)
        self.assertIn("<td>100.5 × 100 × 100</td>", text)
        self.assertIn("<td class=text>box on box 0.5, on floor and walls 0.5</td>", text)
        with h5py.File(self.folder / "results.h5", "r+") as file:
            for key, value in (("Contact/FrictionModel", "pairs"), ("Contact/BoxFloor", "0.3")):
                file["inputs/settings"].attrs[key] = value
        self.assertIn("<td class=text>box on box 0.5, on the floor 0.3, on walls 0.5</td>", self.report()[1])
        self.assertNotIn("of materials", self.report()[1])
        with h5py.File(self.folder / "results.h5", "r+") as file:
            for key, value in (("Friction/carton, pallet", "0.5"), ("Friction/pallet, floor", "0.45")):
                file["inputs/settings"].attrs[key] = value
        self.assertIn("<td>of materials</td><td class=text>carton, pallet 0.5; pallet, floor 0.45</td>", self.report()[1])
        with h5py.File(self.folder / "results.h5", "r+") as file:
            for key, value in (("Contact/FrictionModel", "product"), ("Material pallet/Friction", "0.4")):
                file["inputs/settings"].attrs[key] = value
        self.assertIn("<td class=text>pallet on pallet 0.16, on floor and walls 0.283</td>", self.report()[1])
        self.assertIn("<span class=bad>100.2 %</span>", text)

    def test_a_margin_is_told_rounded_down_and_compared_with_what_is_needed(self):
        self.screen("--layouts", LAYOUTS / "seed_example.txt", "--margins")
        with h5py.File(self.folder / "results.h5", "r+") as file:
            file["margins/margin_within_limits"][:] = [0.8, 0.505, 0.495, -0.2]
            file["margins/margin"][:] = [1.5, 0.5, 0.57, -0.2]
        _, text = self.report()
        for side, in_place, within, needed in (("front", "1.50+ g", "0.80 g", "0.8 g"), ("rear", "0.50 g", "0.50 g", "0.5 g"),
                                               ("left", "0.57 g", "<span class=bad>0.49 g</span>", "0.5 g"),
                                               ("right", "unstable", "<span class=bad>unstable</span>", "0.5 g")):
            self.assertIn(f"<tr><td>{side}</td><td>{in_place}</td><td>{within}</td><td>{needed}</td>", text)

    def test_most_boxes_of_the_worst_verdict_come_first_then_of_the_next(self):
        self.screen("--layouts", *(LAYOUTS / f"{name}.txt" for name in ("BR15_077_ep", "BR8_009_ep", "BR8_009_layer", "seed_example")))
        with h5py.File(self.folder / "results.h5", "r+") as file:
            summary = file["summary/worlds"]
            # A row per layout, a column per acceleration.
            summary["verdict"][:] = np.ravel([[1, 1, 1, 1], [2, 2, 0, 0], [2, 1, 0, 0], [2, 1, 0, 0]])
            summary["fallen_boxes"][:] = np.ravel([[0, 0, 0, 0], [1, 1, 0, 0], [1, 0, 0, 0], [2, 0, 0, 0]])
            for name in ("moved_boxes", "tilted_boxes"):
                summary[name][:] = np.ravel([[30, 30, 30, 30], [1, 1, 0, 0], [9, 1, 0, 0], [2, 1, 0, 0]])
        _, text = self.report()
        self.assertEqual(re.findall(r"<h2>(.*?).txt</h2>", text), ["seed_example", "BR8_009_ep", "BR8_009_layer", "BR15_077_ep"])
        self.assertIn("4 of 4 layouts do not hold. The worst come first: those with most boxes that are unstable, then", text)

    def test_the_worst_come_first_and_the_rest_is_named(self):
        self.screen("--layouts", LAYOUTS / "seed_example.txt", LAYOUTS / "unstable_BR2_007_bpjs.txt")
        told, text = self.report("--most", "1")
        self.assertEqual(told, "report.html: 1 of 2 layouts; --most 2 writes all\n")
        self.assertEqual(re.findall(r"<h2>(.*?)</h2>", text), ["unstable_BR2_007_bpjs.txt"])

    def test_loads_that_hold_and_bad_layouts_are_told(self):
        self.write("good.txt", "1 1\n0 0 0 100 100 20 1\n")
        self.write("bad.txt", "1 1\n0 0 0 100 100\n")
        self.write("rest.txt", "0 1 0 0 0\n")
        self.run_here("screen", "--quiet", "--layouts", "good.txt", "bad.txt", "--accelerations", "rest.txt")
        told, text = self.report()
        self.assertIn("1 of 2 layouts does not hold.", text)
        self.assertEqual(told, "report.html: 2 layouts\n")
        self.assertIn("bad.txt:2", text)
        self.run_here("screen", "--quiet", "--layouts", "good.txt", "--accelerations", "rest.txt", "--overwrite")
        told, text = self.report()
        self.assertEqual(told, "report.html: 1 layout\n")
        self.assertIn("<span class=good>holds under its acceleration</span>", text)

    def of_load(self, load, *arguments):
        """A report of a load whose boxes slide to the right."""
        self.write("left.txt", "0 2 0 -9 0\n")
        self.assert_exit(self.run_here("screen", "--quiet", "--layouts", load, "--accelerations", "left.txt", "--overwrite", *arguments), 0)
        return self.report()[1]

    def test_a_load_is_told_with_its_container_names_masses_and_mats(self):
        text = self.of_load(TRAILER, "--margins")
        self.assertIn("<td>container</td><td class=text>each layout has its own</td>", text)
        self.assertRegex(text, r"<p>20 boxes of 12690 kg, \d+ % of the container's volume; <span class=bad>fails under 1 of 1 acceleration</span>.</p>")
        self.assertRegex(text, r"<td>container</td><td class=text>trailer-curtain, 13.6\d* × 2.4\d* × 2.\d+ m; left, right open;")
        self.assertIn("Axle loads are not calculated.", text)
        self.assertRegex(text, r"<tr><td>Paper</td><td>2</td><td>80 × 120 × 160</td><td>840 to 855 kg</td><td>1695 kg</td>"
                               r"<td class=text>3, 4</td></tr>")
        self.assertIn("<p class=note>On a mat of 0.6: boxes 7, 8, 11, 12, 15, 16.</p>", text)
        self.assertRegex(text, "<p class=note>Left, right.* open; floor 120 cm above the ground.")
        first = int(datasets(self.folder / "results.h5")["/summary/worlds/critical_box"][0])
        name = TRAILER.read_text().splitlines()[first].split(",")[0]
        self.assertRegex(text, rf"<td class=\"text name\">box {first}, {name}, \d\.\d\d s</td>")
        self.assertIn(f"<p>Under left.txt, box {first}, {name}, which goes first, leaves through the open right side", text)
        self.assertRegex(text, r"<td>right</td>.*?<td class=\"text name\">box \d+, \w+ \d</td>")
        self.assertRegex(text, r"<td>1?\d</td><td class=\"text name\">\w+ \d</td><td>80 × 120 × \d+</td><td>\d\d\d</td><td>\d+ \(")
        self.assertNotIn("may bear", text)
        # A name that is too long for a line takes two.
        labels = [element.text for element in pictures_of(text)["top"].iter(f"{SVG}text")]
        self.assertIn("Drinks", labels)
        self.assertIn("1", labels)
        # Drawn to the size of its own container: boxes are 0.8 m of 13.6 m wide.
        top = views(text)[0]
        width = [max(x for x, _ in corners) - min(x for x, _ in corners) for _, corners in top]
        self.assertAlmostEqual(width[-1] / max(width), 0.8 / 13.6, delta=0.002)

        with h5py.File(self.folder / "results.h5", "r+") as file:
            names = file["inputs/layouts/box_name"][:]
            names[first - 1] = "<b>“Pumpe”</b> & more of it than a line of the page has".encode()
            names[first] = ("x" + "é" * 60).encode()[:120]  # cut within a letter
            file["inputs/layouts/box_name"][:] = names
            file["inputs/layouts/bearing_limit"][:] = [np.nan, 1200.0, *[40.25] * 18]
            file["inputs/layouts/fixed"][19] = 1
        text = self.report()[1]
        self.assertIn(f"box {first}, &lt;b&gt;“Pumpe”&lt;/b&gt; &amp; more of it than a line…, ", text)
        self.assertNotIn("<b>", text)
        self.assertIn("<th>may bear, kg</th>", text)
        self.assertIn("<td>40.2</td>", text)
        self.assertIn("<p>19 boxes of 12175 kg", text)
        self.assertIn(", and 1 fixed;", text)

    def test_what_rests_on_boxes_with_a_limit_is_that_of_check(self):
        """A plank across two posts with a box on top, near the first post: statics leaves its share open."""
        rows = [("Post 1", 100, 100, 0, 50, 40, 100, 50, 12), ("Post 2", 250, 100, 0, 50, 40, 100, 50, 13), ("Plank", 100, 100, 100, 200, 40, 10, 20, 1.5),
                ("Box <b>", 120, 110, 110, 20, 20, 20, 2, "")]
        self.write("bridge.csv", "name,x,y,z,length,width,height,mass,bearing limit\n" + "\n".join(",".join(map(str, row)) for row in rows) + "\n")
        self.write("plain.csv", "x,y,z,length,width,height\n0,0,0,80,60,200\n")
        table = self.run_here("check", "bridge.csv", "--bearing").stdout
        ranges = [tuple(map(float, row)) for row in re.findall(r" ([\d.]+) +([\d.]+) +(?:[\d.]+|-)$", table, re.MULTILINE)]
        self.assertEqual(len(ranges), 4)
        text = self.of_load("bridge.csv", "--layouts", "plain.csv")
        _, table = text.split("What rests on boxes with a limit")
        found = re.findall(r"<tr><td>(\d)</td><td class=\"text name\">([^<]+)</td><td>(.*?)</td><td>(.*?)</td><td>([\d.]+)</td></tr>", table)
        self.assertEqual([row[:2] + row[4:] for row in found], [("3", "Plank", "1.5"), ("1", "Post 1", "12.0"), ("2", "Post 2", "13.0")])
        for box, _, least, largest, _ in found:
            for shown, load in zip((least, largest), ranges[int(box) - 1]):
                self.assertAlmostEqual(float(re.sub("<.*?>", "", shown)), load, delta=0.051)
        marked = [["bad" in cell for cell in row[2:4]] for row in found]
        self.assertEqual(marked, [[True, True], [False, True], [False, True]])

    def test_loads_of_a_planner_have_a_page_each_in_a_container_of_its_type(self):
        text = self.of_load(PLANNER, "--format", "planner")
        self.assertEqual(set(re.findall(r"<h2>(.*?)</h2>", text)), {"planner_export.csv#Unit 1", "planner_export.csv#Unit 2"})
        self.assertEqual(len(re.findall(r"<td>container</td><td class=text>40hc, 12.0\d* × 2.3\d* × 2.\d+ m</td>", text)), 2)
        self.assertIn("<p>1 box of 905 kg, ", text)
        self.assertRegex(text, r"<td class=\"text name\">box 1, Reel, large(, \d\.\d\d s)?</td>")

    def test_a_file_that_has_nothing_of_loads_is_told_as_ever(self):
        text = self.of_load(TRAILER)
        with h5py.File(self.folder / "results.h5", "r+") as file:
            for name in OF_LOADS:
                del file[f"inputs/layouts/{name}"]
            for name in ("Length", "Width", "Height"):
                file["inputs/settings"].attrs[f"Container/{name}"] = {"Length": "1362", "Width": "248", "Height": "270"}[name]
        text = self.report()[1]
        self.assertIn("<td>container</td><td class=text>13.62 × 2.48 × 2.7 m</td>", text)
        self.assertNotIn("Paper", text)
        self.assertIn("<tr><th>box</th><th>size, cm</th><th>mass, kg</th><th>farthest, cm</th>", text)

    def test_a_pdf_has_a_page_per_layout(self):
        self.screen("--layouts", LAYOUTS / "seed_example.txt", LAYOUTS / "BR8_009_ep.txt", "--margins")
        for _ in range(2):  # a report is replaced
            self.assert_exit(self.run_here("report", "results.h5", "-o", "report.pdf"), 0)
        data = (self.folder / "report.pdf").read_bytes()
        self.assertTrue(data.startswith(b"%PDF"))
        self.assertEqual(len(re.findall(rb"/Type /Page\b", data)), 3)  # and the front page

    def test_what_cannot_be_done_is_refused_in_a_line(self):
        self.screen("--layouts", LAYOUTS / "seed_example.txt")
        self.assert_refused(self.run_here("report", "results.h5", "-o", "report.doc"), "report.doc", ".html or .pdf")
        self.write("mine.html", "<p>mine</p>\n")
        self.assert_refused(self.run_here("report", "results.h5", "-o", "mine.html"), "mine.html")
        self.assertEqual((self.folder / "mine.html").read_text(), "<p>mine</p>\n")
        self.write("text.h5", "no results\n")
        self.assert_refused(self.run_here("report", "text.h5"), "text.h5")


if __name__ == "__main__":
    unittest.main()
