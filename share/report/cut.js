// The cut through a tetrahedral mesh: a triangle or a quadrilateral per tet that the plane meets.
var dscCut = (function () {
  'use strict';

  // The point where the side from vertex a to vertex b meets the plane; da and db are the distances of its ends.
  function crossing(points, a, da, b, db, out) {
    var part = da / (da - db);
    for (var k = 0; k < 3; ++k) out.push(points[3 * a + k] + part * (points[3 * b + k] - points[3 * a + k]));
  }

  // mesh: {points: x y z ..., cells: four indices per tet, ...}. axis: 0 to 2. chosen(tet): whether the tet is drawn.
  // colour(tet): red, green, blue from 0 to 1. Returns arrays of coordinates: triangles with their colours, and the sides as
  // lines.
  function slice(mesh, axis, position, chosen, colour) {
    var triangles = [], colours = [], lines = [], corners = [];
    for (var t = 0; t < mesh.cells.length / 4; ++t) {
      var above = [], below = [];
      for (var k = 0; k < 4; ++k) {
        var v = mesh.cells[4 * t + k];
        (mesh.points[3 * v + axis] >= position ? above : below).push(v);
      }
      if (above.length === 0 || below.length === 0 || !chosen(t)) continue;
      corners.length = 0;
      var one = above.length < below.length ? above : below, many = one === above ? below : above;
      var pairs = one.length === 1 ? [[one[0], many[0]], [one[0], many[1]], [one[0], many[2]]]
        : [[one[0], many[0]], [one[0], many[1]], [one[1], many[1]], [one[1], many[0]]];
      pairs.forEach(function (pair) {
        crossing(mesh.points, pair[0], mesh.points[3 * pair[0] + axis] - position, pair[1],
          mesh.points[3 * pair[1] + axis] - position, corners);
      });
      var c = colour(t), n = pairs.length;
      for (var i = 1; i + 1 < n; ++i) {
        [0, i, i + 1].forEach(function (corner) {
          triangles.push(corners[3 * corner], corners[3 * corner + 1], corners[3 * corner + 2]);
          colours.push(c[0], c[1], c[2]);
        });
      }
      for (i = 0; i < n; ++i) {
        var j = (i + 1) % n;
        lines.push(corners[3 * i], corners[3 * i + 1], corners[3 * i + 2], corners[3 * j], corners[3 * j + 1], corners[3 * j + 2]);
      }
    }
    return {triangles: triangles, colours: colours, lines: lines};
  }

  return {slice: slice};
}());
