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

    def peers(self, cpu_s):
        mesh = {"vertices": 36015, "tets": 196520, "least_quality": 0.0213, "low_quality": 0.25, "least_dihedral": 1.5}
        surface = {"chamfer_percent": 0.0312, "hausdorff99_percent": 0.125, "vertices": 20000, "boundary_edges": 0, "shells": 1, "genus": -1}
        return {"versions": {"dsc": "1.2.3", "CGAL": "5.5.1", "PCL": None},
                "remeshing": {"before": mesh, "rows": [{"program": "dsc", "cpu_s": cpu_s, "wall_s": 2.0, "us_per_vertex": 50.0, **mesh, "ball_change_percent": 2e-14}]},
                "reconstruction": [{"shape": "torus", "points": 20000, "rows": [
                    {"program": "dsc", "cpu_s": cpu_s, "wall_s": 2.0, **surface}, {"program": "PCL", "missing": "left out: not found"}]}]}

    def test_other_programs_are_listed_with_versions_times_and_figures(self):
        text = report.peers_tables([self.peers(1.0), self.peers(4.0), self.peers(2.0)])
        self.assertIn("Versions: dsc 1.2.3, CGAL 5.5.1, PCL left out.", text)
        self.assertIn("| the mesh before |  |  |  | 36,015 | 196,520 | 0.0213 | 0.250 | 1.50 |  |", text)
        self.assertIn("| dsc | 2.00 [1.00, 4.00] | 2.00 [2.00, 2.00] | 50.0 [50.0, 50.0] | 36,015 | 196,520 | 0.0213 | 0.250 | 1.50 | +0.000 |", text)
        self.assertIn("| torus, 20,000 points | dsc | 2.00 [1.00, 4.00] | 2.00 [2.00, 2.00] | 0.0312 | 0.125 | 20,000 | 0 | 1 | -1 |", text)

    def test_a_program_that_is_not_installed_is_a_row_that_says_so(self):
        lines = report.peers_tables([self.peers(1.0)]).splitlines()
        row = next(line for line in lines if "PCL:" in line)
        self.assertTrue(row.startswith("| torus, 20,000 points | PCL: left out: not found | "))
        header = next(line for line in lines if line.startswith("| cloud "))
        self.assertEqual(row.count("|"), header.count("|"))

    def test_a_result_that_differs_between_runs_shows_all_its_values(self):
        first, second = self.peers(1.0), self.peers(1.0)
        second["remeshing"]["rows"][0]["tets"] = 190000
        self.assertIn("| 190,000 / 196,520 |", report.peers_tables([first, second]))

    def test_a_build_without_the_program_says_so(self):
        self.assertIn("dsc_bench_peers", report.peers_tables([]))


if __name__ == "__main__":
    unittest.main()
