// Fills every element of class "viewer" with the surface at each kept step, the cloud, and the cut through the tets. One WebGL
// context draws all viewers; each viewer shows its own copy, so a page may have any number of them, and they can be printed.
(function () {
  'use strict';

  var LABELS = [[0.78, 0.85, 0.90], [0.93, 0.66, 0.38], [0.47, 0.71, 0.58], [0.57, 0.54, 0.79], [0.80, 0.49, 0.60], [0.62, 0.52, 0.40]];
  // Colour scale from good to bad. People who cannot distinguish red and green can also read it.
  var DISTANCE = [[0.13, 0.35, 0.55], [0.16, 0.60, 0.62], [0.55, 0.75, 0.38], [0.96, 0.76, 0.20], [0.85, 0.28, 0.16]];
  var QUALITY = DISTANCE.slice().reverse();
  var AXES = ['x', 'y', 'z'];
  var PLAIN_HEX = 0xd9bd94, PLAIN = [0xd9 / 255, 0xbd / 255, 0x94 / 255];  // the surface's outside
  var NO_LEVEL = 255;  // of a vertex without a value

  function ramp(stops, part) {
    var at = Math.max(0, Math.min(1, part)) * (stops.length - 1), low = Math.min(Math.floor(at), stops.length - 2), rest = at - low;
    return stops[low].map(function (value, k) { return value + rest * (stops[low + 1][k] - value); });
  }

  function css(stops) {
    return 'linear-gradient(to right, ' + stops.map(function (c) {
      return 'rgb(' + c.map(function (v) { return Math.round(255 * v); }).join(',') + ')';
    }).join(', ') + ')';
  }

  function bytes(text) {
    var raw = atob(text), out = new Uint8Array(raw.length);
    for (var i = 0; i < raw.length; ++i) out[i] = raw.charCodeAt(i);
    return out;
  }

  function indices(packed) {
    var buffer = bytes(packed.data).buffer;
    return packed.wide ? new Uint32Array(buffer) : new Uint16Array(buffer);
  }

  // Coordinates relative to `place.centre`, in units of `place.size`: far from the origin a float would lose its digits.
  function coordinates(packed, place) {
    var whole = new Uint16Array(bytes(packed.data).buffer), out = new Float32Array(whole.length);
    for (var i = 0; i < whole.length; ++i) {
      var k = i % 3;
      out[i] = (packed.low[k] + packed.step[k] * whole[i] - place.centre[k]) / place.size;
    }
    return out;
  }

  function placeOf(data) {
    var packed = data.frames.length ? data.frames[data.frames.length - 1].mesh.points : data.cloud.points, square = 0, centre = [];
    for (var k = 0; k < 3; ++k) {
      var size = 65535 * packed.step[k];
      centre.push(packed.low[k] + 0.5 * size);
      square += size * size;
    }
    return {centre: centre, size: 0.5 * Math.sqrt(square) || 1};
  }

  // Three digits, without unnecessary zeros.
  function figure(value) {
    return String(Number(value.toPrecision(3)));
  }

  function make(name, properties, parent) {
    var element = document.createElement(name);
    Object.keys(properties).forEach(function (key) { element[key] = properties[key]; });
    if (parent) parent.appendChild(element);
    return element;
  }

  function labelled(bar, text, control, after) {
    var label = make('label', {}, bar);
    if (after) label.appendChild(control);
    label.appendChild(document.createTextNode(text));
    if (!after) label.appendChild(control);
    return control;
  }

  var shared = null;
  function renderer() {
    if (!shared) {
      shared = new THREE.WebGLRenderer({antialias: true});
      shared.localClippingEnabled = true;
      shared.setClearColor(0xeef2f5);
    }
    return shared;
  }

  function View(root, data) {
    this.data = data;
    this.place = placeOf(data);
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(32, 16 / 9, 0.01, 60);
    this.plane = new THREE.Plane(new THREE.Vector3(-1, 0, 0), 0);
    this.pending = false;
    this.frames = {};
    this.cutKey = '';
    this.root = root;
    this.canvas = make('canvas', {tabIndex: 0}, root);
    this.canvas.setAttribute('aria-label', 'the surface, to turn');
    this.light();
    this.panel();
    this.home();
    var view = this;
    window.addEventListener('resize', function () { view.ask(); });
    window.addEventListener('beforeprint', function () { view.draw(); });
    this.ask();
  }

  View.prototype.light = function () {
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0xa9b4bd, 0.62));
    this.scene.add(this.camera);
    var key = new THREE.DirectionalLight(0xffffff, 0.55), fill = new THREE.DirectionalLight(0xffffff, 0.18);
    key.position.set(-1.2, 1.6, 1.5);
    fill.position.set(1.8, -0.4, 0.8);
    this.camera.add(key);
    this.camera.add(fill);
  };

  View.prototype.panel = function () {
    var view = this, data = this.data, redraw = function () { view.ask(); };
    var first = make('div', {className: 'bar'}, this.root);
    this.step = make('input', {type: 'range', className: 'step', min: 0, max: Math.max(0, data.frames.length - 1), step: 1});
    this.step.value = this.step.max;
    this.stepName = make('output', {});
    if (data.frames.length > 1) {
      labelled(first, 'step', this.step);
      first.appendChild(this.stepName);
    }
    this.showSurface = labelled(first, 'surface', make('input', {type: 'checkbox', className: 'surface', checked: true}), true);
    this.showEdges = labelled(first, 'edges', make('input', {type: 'checkbox', className: 'edges'}), true);
    this.showCloud = make('input', {type: 'checkbox', className: 'cloud'});
    if (data.cloud) labelled(first, 'cloud', this.showCloud, true);
    this.attribute = make('select', {className: 'attribute'});
    make('option', {value: '', textContent: 'none'}, this.attribute);
    // The last frame is the result; the other frames have no attribute that the result does not have.
    var result = data.frames[data.frames.length - 1], attributes = result && result.attributes || [];
    attributes.forEach(function (a) { make('option', {value: a.name, textContent: a.name}, view.attribute); });
    if (attributes.length) labelled(first, 'colour surface by', this.attribute);
    make('button', {type: 'button', textContent: 'reset view', onclick: function () { view.home(); view.ask(); }}, first);
    this.surfaceLegend = make('span', {className: 'legend surface-legend'}, first);
    this.surfaceLegend.setAttribute('role', 'status');
    this.cloudLegend = make('span', {className: 'legend'}, first);
    if (data.cloud && data.cloud.distance) this.legend(this.cloudLegend, DISTANCE, '0', data.cloud.top.toPrecision(2) + ' and more', 'point to surface');

    var second = make('div', {className: 'bar'}, data.tets ? this.root : null);
    this.cut = labelled(second, 'cut', make('input', {type: 'checkbox', className: 'cut'}), true);
    this.axis = labelled(second, 'across', make('select', {className: 'axis'}));
    AXES.forEach(function (name) { make('option', {textContent: name}, view.axis); });
    this.axis.value = data.up === 'z' ? 'y' : 'z';
    this.position = labelled(second, 'at', make('input', {type: 'range', className: 'position', min: 0, max: 1000, step: 1, value: 500}));
    this.colour = labelled(second, 'colour', make('select', {className: 'colour'}));
    make('option', {value: 'label', textContent: 'label'}, this.colour);
    make('option', {value: 'quality', textContent: 'quality'}, this.colour);
    this.outside = labelled(second, 'outside', make('input', {type: 'checkbox', className: 'outside', checked: true}), true);
    this.cutLegend = make('span', {className: 'legend'}, second);
    this.legend(this.cutLegend, QUALITY, '0', '1', 'quality of the tets');
    [this.showSurface, this.showEdges, this.showCloud].forEach(function (control) { control.addEventListener('change', redraw); });
    // A change of the cut's controls switches the cut on.
    [this.cut, this.axis, this.position, this.colour, this.outside].forEach(function (control) {
      control.addEventListener('input', function () {
        if (control !== view.cut) view.cut.checked = true;
        redraw();
      });
    });
    this.step.addEventListener('input', redraw);
    this.attribute.addEventListener('input', redraw);
  };

  View.prototype.legend = function (element, stops, low, high, what) {
    make('span', {textContent: what + ' ' + low}, element);
    make('span', {className: 'ramp'}, element).style.background = css(stops);
    make('span', {textContent: high}, element);
  };

  View.prototype.home = function () {
    var z = this.data.up === 'z', from = z ? [0.85, -1.55, 0.75] : [0.85, 0.75, 1.55];
    this.camera.up.set(0, z ? 0 : 1, z ? 1 : 0);
    // OrbitControls reads the up axis only in its constructor, so a new one is made.
    var view = this;
    if (this.controls) this.controls.dispose();
    this.controls = new THREE.OrbitControls(this.camera, this.canvas);
    this.controls.enableKeys = false;
    this.controls.addEventListener('change', function () { view.ask(); });
    this.camera.position.set(from[0], from[1], from[2]).multiplyScalar(1.42);
    this.controls.update();
  };

  // A normal for each corner of each face, as in `dsc render`: the area-weighted mean over the faces at the corner's point that
  // are within 40 degrees of the face. So it is smooth over gentle edges and sharp at creases.
  function cornerNormals(points, faces) {
    var crease = 0.766, count = faces.length / 3, weighted = new Float32Array(3 * count), unit = new Float32Array(3 * count);
    var first = new Uint32Array(points.length / 3 + 1), around = new Uint32Array(faces.length), normals = new Float32Array(3 * faces.length);
    for (var f = 0; f < count; ++f) {
      var a = 3 * faces[3 * f], b = 3 * faces[3 * f + 1], c = 3 * faces[3 * f + 2];
      var ux = points[b] - points[a], uy = points[b + 1] - points[a + 1], uz = points[b + 2] - points[a + 2];
      var vx = points[c] - points[a], vy = points[c + 1] - points[a + 1], vz = points[c + 2] - points[a + 2];
      var n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx], length = Math.hypot(n[0], n[1], n[2]) || 1;
      weighted.set(n, 3 * f);
      unit.set([n[0] / length, n[1] / length, n[2] / length], 3 * f);
    }
    for (var i = 0; i < faces.length; ++i) ++first[faces[i] + 1];
    for (var v = 1; v < first.length; ++v) first[v] += first[v - 1];
    var next = first.slice();
    for (i = 0; i < faces.length; ++i) around[next[faces[i]]++] = (i - i % 3) / 3;
    for (i = 0; i < faces.length; ++i) {
      var own = i - i % 3, x = 0, y = 0, z = 0;
      for (var j = first[faces[i]]; j < first[faces[i] + 1]; ++j) {
        var other = 3 * around[j];
        var near = unit[own] * unit[other] + unit[own + 1] * unit[other + 1] + unit[own + 2] * unit[other + 2] > crease;
        if (other !== own && !near) continue;
        x += weighted[other];
        y += weighted[other + 1];
        z += weighted[other + 2];
      }
      var size = Math.hypot(x, y, z) || 1;
      normals.set([x / size, y / size, z / size], 3 * i);
    }
    return normals;
  }

  View.prototype.frame = function (index) {
    if (this.frames[index]) return this.frames[index];
    var mesh = this.data.frames[index].mesh, group = new THREE.Group(), geometry = new THREE.BufferGeometry(), clip = [this.plane];
    var faces = indices(mesh.faces), points = coordinates(mesh.points, this.place), edges = [], corners = new Float32Array(3 * faces.length);
    for (var corner = 0; corner < faces.length; ++corner) {
      for (var axis = 0; axis < 3; ++axis) corners[3 * corner + axis] = points[3 * faces[corner] + axis];
    }
    geometry.setAttribute('position', new THREE.BufferAttribute(corners, 3));
    geometry.setAttribute('normal', new THREE.BufferAttribute(cornerNormals(points, faces), 3));
    group.faces = faces;
    var offset = {polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1, clippingPlanes: clip};
    var outer = Object.assign({color: PLAIN_HEX, specular: 0x0d0d0d, shininess: 20, side: THREE.FrontSide}, offset);
    var coloured = Object.assign({}, outer, {color: 0xffffff, vertexColors: THREE.VertexColors});
    var inner = Object.assign({color: 0x8797a5, specular: 0x000000, side: THREE.BackSide}, offset);
    group.surface = new THREE.Group();
    group.plain = new THREE.MeshPhongMaterial(outer);
    group.coloured = new THREE.MeshPhongMaterial(coloured);
    group.outside = new THREE.Mesh(geometry, group.plain);
    group.shown = '';
    group.surface.add(group.outside);
    group.surface.add(new THREE.Mesh(geometry, new THREE.MeshPhongMaterial(inner)));
    for (var i = 0; i < faces.length; ++i) {
      var next = i % 3 === 2 ? i - 2 : i + 1;
      if (faces[i] < faces[next]) edges.push(faces[i], faces[next]);
    }
    var lines = new THREE.BufferGeometry();
    lines.setAttribute('position', new THREE.BufferAttribute(points, 3));
    lines.setIndex(new THREE.BufferAttribute(new Uint32Array(edges), 1));
    group.edges = new THREE.LineSegments(lines, new THREE.LineBasicMaterial({color: 0x2c3a45, transparent: true, opacity: 0.55, clippingPlanes: clip}));
    group.add(group.surface);
    group.add(group.edges);
    this.scene.add(group);
    this.frames[index] = group;
    return group;
  };

  // Colours the outside of a frame by the chosen attribute and shows the meaning of the colours. A step may not have the
  // attribute.
  View.prototype.colourBy = function (index) {
    var name = this.attribute.value, group = this.frames[index], key = index + ' ' + name;
    var found = (this.data.frames[index].attributes || []).filter(function (a) { return a.name === name; })[0];
    this.surfaceLegend.style.display = name && this.showSurface.checked ? '' : 'none';
    if (key !== this.legendKey) {
      this.legendKey = key;
      this.surfaceLegend.textContent = name && !found ? name + ': no values at this step' : '';
      if (found) this.legend(this.surfaceLegend, DISTANCE, figure(found.low) + ' and less', figure(found.high) + ' and more', name + ':');
    }
    group.outside.material = found ? group.coloured : group.plain;
    if (!found || group.shown === name) return;
    group.shown = name;
    var geometry = group.outside.geometry, levels = bytes(found.data);
    var faces = group.faces;
    if (!geometry.getAttribute('color')) geometry.setAttribute('color', new THREE.BufferAttribute(new Float32Array(3 * faces.length), 3));
    var colours = geometry.getAttribute('color');
    for (var i = 0; i < faces.length; ++i) {
      var level = levels[faces[i]];
      colours.array.set(level === NO_LEVEL ? PLAIN : ramp(DISTANCE, level / (NO_LEVEL - 1)), 3 * i);
    }
    colours.needsUpdate = true;
  };

  View.prototype.cloud = function () {
    if (this.cloudPoints || !this.data.cloud) return this.cloudPoints;
    var cloud = this.data.cloud, geometry = new THREE.BufferGeometry(), position = coordinates(cloud.points, this.place);
    var levels = cloud.distance ? bytes(cloud.distance) : null, colours = new Float32Array(position.length);
    for (var i = 0; i < position.length / 3; ++i) colours.set(levels ? ramp(DISTANCE, levels[i] / 255) : [0.2, 0.3, 0.4], 3 * i);
    geometry.setAttribute('position', new THREE.BufferAttribute(position, 3));
    geometry.setAttribute('color', new THREE.BufferAttribute(colours, 3));
    var material = new THREE.PointsMaterial({size: 0.018, vertexColors: THREE.VertexColors, clippingPlanes: [this.plane]});
    this.cloudPoints = new THREE.Points(geometry, material);
    this.scene.add(this.cloudPoints);
    return this.cloudPoints;
  };

  View.prototype.tets = function () {
    if (!this.tetMesh) {
      var packed = this.data.tets, points = coordinates(packed.points, this.place), low = [9, 9, 9], high = [-9, -9, -9];
      var last = coordinates(this.data.frames[this.data.frames.length - 1].mesh.points, this.place);
      for (var i = 0; i < last.length; ++i) {
        low[i % 3] = Math.min(low[i % 3], last[i]);
        high[i % 3] = Math.max(high[i % 3], last[i]);
      }
      this.tetMesh = {points: points, cells: indices(packed.cells), labels: bytes(packed.labels), quality: bytes(packed.quality), low: low, high: high};
    }
    return this.tetMesh;
  };

  // The plane follows the slider; the side towards the camera is cut away.
  View.prototype.cutAt = function (axis) {
    var mesh = this.tets(), part = this.position.value / 1000;
    var at = mesh.low[axis] + part * (mesh.high[axis] - mesh.low[axis]) + 1e-5;
    var sign = this.camera.position.getComponent(axis) >= at ? -1 : 1;
    this.plane.normal.set(0, 0, 0).setComponent(axis, sign);
    this.plane.constant = -sign * at;
    var byQuality = this.colour.value === 'quality', outside = this.outside.checked;
    var key = [axis, at, byQuality, outside].join(' ');
    if (key === this.cutKey) return;
    this.cutKey = key;
    if (this.cutMesh) {
      this.scene.remove(this.cutMesh);
      this.cutMesh.children.forEach(function (child) { child.geometry.dispose(); child.material.dispose(); });
    }
    var slice = dscCut.slice(mesh, axis, at, function (t) { return outside || mesh.labels[t] > 0; }, function (t) {
      if (byQuality) return ramp(QUALITY, mesh.quality[t] / 255);
      var label = mesh.labels[t];
      return label === 0 ? LABELS[0] : LABELS[1 + (label - 1) % (LABELS.length - 1)];
    });
    var faces = new THREE.BufferGeometry(), lines = new THREE.BufferGeometry();
    faces.setAttribute('position', new THREE.Float32BufferAttribute(slice.triangles, 3));
    faces.setAttribute('color', new THREE.Float32BufferAttribute(slice.colours, 3));
    lines.setAttribute('position', new THREE.Float32BufferAttribute(slice.lines, 3));
    this.cutMesh = new THREE.Group();
    this.cutMesh.add(new THREE.Mesh(faces, new THREE.MeshBasicMaterial({vertexColors: THREE.VertexColors, side: THREE.DoubleSide,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1})));
    this.cutMesh.add(new THREE.LineSegments(lines, new THREE.LineBasicMaterial({color: 0x2c3a45, transparent: true, opacity: 0.4})));
    this.scene.add(this.cutMesh);
  };

  View.prototype.ask = function () {
    var view = this;
    if (this.pending) return;
    this.pending = true;
    window.requestAnimationFrame(function () { view.draw(); });
  };

  View.prototype.update = function () {
    var count = this.data.frames.length, index = Number(this.step.value), last = index === count - 1, view = this;
    if (count) {
      this.stepName.textContent = this.data.frames[index].label;
      this.frame(index);
      this.colourBy(index);
    }
    Object.keys(this.frames).forEach(function (key) {
      var shown = Number(key) === index;
      view.frames[key].surface.visible = shown && view.showSurface.checked;
      view.frames[key].edges.visible = shown && view.showEdges.checked;
    });
    if (this.showCloud.checked) this.cloud();
    if (this.cloudPoints) this.cloudPoints.visible = this.showCloud.checked;
    this.cloudLegend.style.display = this.showCloud.checked ? '' : 'none';
    // Intermediate steps have surfaces but no tets.
    var cut = Boolean(this.data.tets) && this.cut.checked && last;
    if (cut) this.cutAt(AXES.indexOf(this.axis.value));
    else this.plane.set(new THREE.Vector3(1, 0, 0), 1e6);
    if (this.cutMesh) this.cutMesh.visible = cut;
    this.cutLegend.style.display = cut && this.colour.value === 'quality' ? '' : 'none';
  };

  View.prototype.draw = function () {
    this.pending = false;
    var ratio = Math.min(window.devicePixelRatio || 1, 2), width = Math.round(this.canvas.clientWidth * ratio);
    var height = Math.round(this.canvas.clientHeight * ratio), gl = renderer();
    if (!width || !height) return;
    this.update();
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    gl.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    gl.render(this.scene, this.camera);
    this.canvas.getContext('2d').drawImage(gl.domElement, 0, 0);
    this.root.setAttribute('data-drawn', String(1 + Number(this.root.getAttribute('data-drawn') || 0)));
  };

  Array.prototype.forEach.call(document.querySelectorAll('.viewer'), function (root) {
    var standIn = root.querySelector('.stand-in');
    try {
      renderer();
    } catch (error) {
      make('p', {className: 'sorry', textContent: 'This browser has no WebGL; a fixed picture replaces the view that can be rotated.'}, root);
      return;
    }
    if (standIn) standIn.remove();
    new View(root, JSON.parse(document.getElementById(root.id + '-scene').textContent));
  });
}());
