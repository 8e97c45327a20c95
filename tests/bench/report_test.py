#!/usr/bin/env python3
"""report.py: figures with their spread, and a page that keeps what was written by hand."""

import unittest

import report


class Report(unittest.TestCase):
    def test_a_figure_is_the_median_with_its_spread(self):
        self.assertEqual(report.spread([3.0, 1.0, 20.0]), "3.00 [1.00, 20.0]")
        self.assertEqual(report.spread([0.0123]), "0.0123")
        self.assertEqual(report.spread([0.001, 0.002, 0.003], 1e3), "2.00 [1.00, 3.00]")
        self.assertEqual(report.short(12345.6), "12,346")

    def test_only_the_part_between_the_markers_is_replaced(self):
        page = f"by hand\n{report.BEGIN}\nold\n{report.END}\nby hand, too\n"
        once = report.replace_measured(page, "new")
        self.assertEqual(once, f"by hand\n{report.BEGIN}\nnew\n{report.END}\nby hand, too\n")
        self.assertEqual(report.replace_measured(once, "new"), once)

    def test_a_page_without_its_markers_is_refused(self):
        for page in ("no markers", f"{report.END}\n{report.BEGIN}", report.BEGIN):
            with self.assertRaises(ValueError):
                report.replace_measured(page, "new")

    def test_the_exponent_is_the_slope_of_the_logarithms(self):
        self.assertAlmostEqual(report.exponent([(10, 5), (100, 50), (1000, 500)]), 1.0)
        self.assertAlmostEqual(report.exponent([(1, 2), (4, 16)]), 1.5)

    def test_repetitions_are_gathered_by_operation_and_mesh_without_those_that_have_no_place(self):
        runs = [{"name": f"{mesh}/flip 2-3/iterations:1/manual_time", "real_time": time} for mesh, time in
                (("start", 5.0), ("start", 7.0), ("start", 6.0), ("million", 9.0))]
        runs.append({"name": "step5/flip 2-3/iterations:1/manual_time", "real_time": 0.0, "error_occurred": True})
        runs.append({"name": "start/flip 2-3/mean", "real_time": 6.0, "run_type": "aggregate"})
        self.assertEqual(report.micro_rows(runs), [["flip 2-3", "6.00 [5.00, 7.00]", "-", "-", "9.00", "-"]])


if __name__ == "__main__":
    unittest.main()
