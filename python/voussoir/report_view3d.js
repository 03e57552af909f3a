// SPDX-License-Identifier: GPL-3.0-or-later
// The moving dam of voussoir report: a model that the reader turns, and the histories of its joints. The data are those of
// report_view3d.py: base64 of little-endian numbers. Lengths in m, stresses in MPa, openings and slips in mm.
"use strict";
(() => {
  const TYPES = {f4: Float32Array, u4: Uint32Array, u2: Uint16Array, i2: Int16Array, u1: Uint8Array};
  const SPEEDS = [[1, "real time"], [0.5, "1/2"], [0.25, "1/4"], [0.1, "1/10"]];
  const UPSTREAM = "#0072b2", DOWNSTREAM = "#d55e00", INK = "#1b1f24";
  const CONCRETE = [0xde, 0xda, 0xd2];
  const STRESS = [[0x05, 0x30, 0x61], [0x43, 0x93, 0xc3], [0xd1, 0xe5, 0xf0], [0xf7, 0xf7, 0xf7], [0xfd, 0xdb, 0xc7], [0xd6, 0x60, 0x4d], [0x67, 0, 0x1f]];
  const PRESSURE = [[0x54, 0x30, 0x05], [0xbf, 0x81, 0x2d], [0xf6, 0xe8, 0xc3], [0xf5, 0xf5, 0xf5], [0xc7, 0xea, 0xe5], [0x35, 0x97, 0x8f], [0, 0x3c, 0x30]];
  const OPENING = [CONCRETE, [0xf0, 0xc2, 0x7b], [0xdd, 0x7a, 0x3b], [0xa9, 0x2b, 0x1f], [0x5a, 0x0d, 0x12]];

  // All texts of the data are compressed bytes in base64.
  const unpacked = async (data) => {
    if (typeof data === "string") {
      const bytes = new Blob([Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0))]);
      return new Uint8Array(await new Response(bytes.stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer());
    }
    if (data === null || typeof data !== "object" || Array.isArray(data)) return data;
    return Object.fromEntries(await Promise.all(Object.entries(data).map(async ([name, value]) => [name, await unpacked(value)])));
  };

  const nameOf = (data, joint) => Object.fromEntries(data.history.names)[joint];

  const numbers = (bytes, type) => new TYPES[type](bytes.buffer);

  // Integers over time, from their second differences: n of each time, low bytes before high bytes.
  const overTime = (bytes, type, n) => {
    const size = TYPES[type].BYTES_PER_ELEMENT, count = bytes.length / size, result = new TYPES[type](count), steps = new TYPES[type](n);
    for (let i = 0; i < count; ++i) {
      steps[i % n] += size === 2 ? bytes[i] + 256 * bytes[count + i] : bytes[i];
      result[i] = (i < n ? 0 : result[i - n]) + steps[i % n];
    }
    return result;
  };

  // A column of numbers of 16 bits in its unit.
  const values = (column) => Array.from(numbers(column.numbers, "i2"), (x) => column.unit * x);

  const element = (parent, tag, name, text) => {
    const made = document.createElement(tag);
    if (name) made.className = name;
    if (text !== undefined) made.textContent = text;
    parent.appendChild(made);
    return made;
  };

  // Colours of 0 ... 255, three numbers of 0 ... 1 each.
  const table = (stops) => {
    const colours = new Float32Array(768);
    for (let i = 0; i < 256; ++i) {
      const at = i / 255 * (stops.length - 1), k = Math.min(Math.floor(at), stops.length - 2);
      for (let c = 0; c < 3; ++c) colours[3 * i + c] = (stops[k][c] + (at - k) * (stops[k + 1][c] - stops[k][c])) / 255;
    }
    return colours;
  };
  const STRESS_COLOURS = table(STRESS), PRESSURE_COLOURS = table(PRESSURE), OPENING_COLOURS = table(OPENING);

  const shown = (value, digits) => value.toFixed(digits).replace("-", "\u2212");
  const digitsOf = (top) => top >= 100 ? 0 : top >= 10 ? 1 : 2;

  // ---------------------------------------------------------------- the model

  class Model {
    constructor(stage, data) {
      this.data = data;
      this.points = numbers(data.points, "f4");
      this.n = this.points.length / 3;
      this.moved = overTime(data.moved, "i2", 3 * this.n);
      this.edges = numbers(data.edges, "u4");
      this.edgeJoints = numbers(data.edgeJoints, "u2");
      this.stress = data.stress && overTime(data.stress, "u1", this.n);
      this.pressure = data.pressure && overTime(data.pressure, "u1", this.n);
      this.envelope = data.envelope && numbers(data.envelope, "u1");
      this.jointNodes = numbers(data.jointNodes, "u4");
      this.nodeJoints = numbers(data.nodeJoints, "u2");
      this.opening = overTime(data.opening, "u1", this.jointNodes.length);
      this.at = 0;
      this.factor = data.factor;
      this.mode = this.stress ? "stress" : "opening";
      this.joint = 0;
      this.drawn = 0; // number of pictures so far
      this.stage = stage;
      this.renderer = new THREE.WebGLRenderer({antialias: true, alpha: true});
      this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
      this.canvas = this.renderer.domElement;
      stage.appendChild(this.canvas);
      this.makeScene();
      this.makeCamera();
      this.update();
    }

    makeScene() {
      const scene = this.scene = new THREE.Scene(), quads = numbers(this.data.quads, "u4");
      this.position = new THREE.BufferAttribute(new Float32Array(3 * this.n), 3);
      this.colour = new THREE.BufferAttribute(new Float32Array(3 * this.n), 3);
      const triangles = new Uint32Array(quads.length / 4 * 6);
      for (let q = 0; q < quads.length / 4; ++q)
        [0, 1, 2, 0, 2, 3].forEach((corner, k) => { triangles[6 * q + k] = quads[4 * q + corner]; });
      const geometry = (index) => {
        const made = new THREE.BufferGeometry();
        made.setAttribute("position", this.position);
        made.setAttribute("color", this.colour);
        made.setIndex(new THREE.BufferAttribute(index, 1));
        return made;
      };
      this.surface = new THREE.Mesh(geometry(triangles), new THREE.MeshPhongMaterial(
        {vertexColors: THREE.VertexColors || true, flatShading: true, shininess: 0, specular: 0, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1}));
      const sides = new Set();
      for (let q = 0; q < quads.length; q += 4)
        for (let k = 0; k < 4; ++k) {
          const a = quads[q + k], b = quads[q + (k + 1) % 4];
          sides.add(Math.min(a, b) * this.n + Math.max(a, b));
        }
      const mesh = new Uint32Array(2 * sides.size);
      [...sides].forEach((side, i) => { mesh[2 * i] = Math.floor(side / this.n); mesh[2 * i + 1] = side % this.n; });
      const lines = (index, colour, opacity) => new THREE.LineSegments(geometry(index), new THREE.LineBasicMaterial({color: colour, transparent: true, opacity: opacity}));
      this.selected = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial(
        {color: 0x0b5394, size: 4.5 * this.renderer.getPixelRatio(), sizeAttenuation: false}));
      this.all = [this.surface, lines(mesh, 0x30363d, 0.13), lines(this.edges, 0x14171c, 0.9), this.selected];
      for (const object of this.all) {
        object.frustumCulled = false;
        scene.add(object);
      }
    }

    makeCamera() {
      const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
      this.points.forEach((x, i) => { low[i % 3] = Math.min(low[i % 3], x); high[i % 3] = Math.max(high[i % 3], x); });
      this.middle = new THREE.Vector3(...low.map((x, c) => (x + high[c]) / 2));
      this.size = Math.max(...low.map((x, c) => high[c] - x));
      this.camera = new THREE.PerspectiveCamera(30, 1, this.size / 50, this.size * 20);
      this.camera.up.set(0, 0, 1);
      this.scene.add(new THREE.AmbientLight(0xffffff, 0.7), this.camera);
      const light = new THREE.DirectionalLight(0xffffff, 0.32);
      light.position.set(-0.25, 0.6, 0.8); // moves with the camera
      this.camera.add(light, light.target);
      light.target.position.set(0, 0, -1);
      this.controls = new THREE.OrbitControls(this.camera, this.canvas);
      this.controls.enableKeys = false;
      this.controls.enableZoom = false; // until the reader has touched the view: the wheel moves the page
      this.controls.addEventListener("change", () => { this.keepInside(); this.draw(); });
      this.resize();
      this.look();
    }

    // The camera at the start: from downstream, above, as in the picture; for the pressure of the water from upstream.
    look() {
      const azimuth = (this.mode === "pressure" ? 168 : -12) * Math.PI / 180, elevation = (this.mode === "pressure" ? 15 : 30) * Math.PI / 180;
      const back = new THREE.Vector3(Math.cos(elevation) * Math.cos(azimuth), Math.cos(elevation) * Math.sin(azimuth), Math.sin(elevation));
      const centre = this.middle.clone(), point = new THREE.Vector3(), x = this.points;
      let distance = 2 * this.size;
      for (let round = 0; round < 4; ++round) { // until the dam fills the stage
        const low = [1e9, 1e9], high = [-1e9, -1e9];
        this.camera.position.copy(back).multiplyScalar(distance).add(centre);
        this.camera.lookAt(centre);
        this.camera.updateMatrixWorld();
        for (let i = 0; i < this.n; ++i) {
          const at = point.set(x[3 * i], x[3 * i + 1], x[3 * i + 2]).project(this.camera).toArray();
          for (let c = 0; c < 2; ++c) { low[c] = Math.min(low[c], at[c]); high[c] = Math.max(high[c], at[c]); }
        }
        const height = 2 * distance * Math.tan(this.camera.fov / 360 * Math.PI); // of the stage, at the dam [m]
        const right = point.setFromMatrixColumn(this.camera.matrixWorld, 0).multiplyScalar((low[0] + high[0]) / 4 * height * this.camera.aspect);
        centre.add(right).add(point.clone().setFromMatrixColumn(this.camera.matrixWorld, 1).multiplyScalar((low[1] + high[1]) / 4 * height));
        distance *= Math.max((high[0] - low[0]) / 1.84, (high[1] - low[1]) / 1.5);
      }
      this.distance = null; // until the camera has its place
      this.controls.target.copy(centre);
      this.camera.position.copy(back).multiplyScalar(distance).add(centre);
      this.controls.update();
      Object.assign(this, {distance: distance, nearest: distance, zoom: 1, target: centre.clone()});
      this.keepInside();
      this.draw();
    }

    // Turns the camera about its target by these angles [rad], and changes its distance by a factor.
    turn(azimuth, elevation, factor) {
      const {camera, controls} = this, back = camera.position.clone().sub(controls.target), length = back.length();
      const a = Math.atan2(back.y, back.x) + azimuth, e = Math.max(-1.5, Math.min(1.5, Math.asin(back.z / length) + elevation));
      back.set(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)).multiplyScalar(factor * length);
      camera.position.copy(back).add(controls.target);
      controls.update();
    }

    // Middle and half of the way of each coordinate of the nodes over time, magnified.
    reach() {
      if (this.reached === this.factor) return;
      this.reached = this.factor;
      const n = 3 * this.n, scale = this.factor * this.data.unit;
      const low = new Float32Array(n).fill(Infinity), high = new Float32Array(n).fill(-Infinity);
      this.moved.forEach((u, k) => { low[k % n] = Math.min(low[k % n], u); high[k % n] = Math.max(high[k % n], u); });
      this.mean = this.points.map((x, i) => x + scale * (low[i] + high[i]) / 2);
      this.half = this.points.map((x, i) => scale * (high[i] - low[i]) / 2);
    }

    // Distance of the camera from its target at which all nodes are in the frame at all times.
    needed() {
      this.reach();
      this.camera.updateMatrixWorld();
      const tan = Math.tan(this.camera.fov / 360 * Math.PI), limits = [0.92 * tan * this.camera.aspect, 0.92 * tan];
      const axes = [0, 1, 2].map((c) => new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, c).toArray()); // right, up, back
      const target = this.controls.target.toArray();
      let needed = 0;
      for (let i = 0; i < 3 * this.n; i += 3) {
        const at = [0, 0, 0], way = [0, 0, 0];
        for (let a = 0; a < 3; ++a)
          for (let c = 0; c < 3; ++c) {
            at[a] += axes[a][c] * (this.mean[i + c] - target[c]);
            way[a] += Math.abs(axes[a][c]) * this.half[i + c];
          }
        for (let a = 0; a < 2; ++a) needed = Math.max(needed, at[2] + way[2] + (Math.abs(at[a]) + way[a]) / limits[a]);
      }
      return needed;
    }

    // The camera goes back where the dam would leave the frame. A zoom or a shift by the reader remains.
    keepInside() {
      if (!this.distance) return;
      const target = this.controls.target, back = this.camera.position.clone().sub(target), now = back.length();
      const wanted = Math.max(this.nearest, this.needed());
      if (Math.abs(now / this.distance - 1) > 1e-6 || target.distanceTo(this.target) > 1e-6 * this.size) this.zoom = now / wanted;
      this.target.copy(target);
      this.distance = this.zoom * wanted;
      this.camera.position.copy(target).add(back.setLength(this.distance));
      this.camera.near = Math.min(this.size / 50, this.distance / 50);
      this.camera.far = Math.max(20 * this.size, 4 * this.distance);
      this.camera.updateProjectionMatrix();
    }

    resize() {
      const width = this.stage.clientWidth, height = this.stage.clientHeight;
      if (!width || !height) return;
      this.renderer.setSize(width, height);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
      this.keepInside();
      this.draw();
    }

    // Positions and colours at the time between two frames, and the picture.
    update() {
      const last = this.data.times.length - 1, k = Math.min(Math.floor(this.at), Math.max(0, last - 1)), w = last ? this.at - k : 0;
      const a = 3 * this.n * k, b = last ? a + 3 * this.n : a, scale = this.factor * this.data.unit, x = this.position.array;
      for (let i = 0; i < x.length; ++i) x[i] = this.points[i] + scale * ((1 - w) * this.moved[a + i] + w * this.moved[b + i]);
      this.position.needsUpdate = true;
      this.paint(k, w, last);
      this.mark();
      this.draw();
    }

    paint(k, w, last) {
      const colours = this.colour.array, next = last ? 1 : 0;
      const set = (node, values, index) => { for (let c = 0; c < 3; ++c) colours[3 * node + c] = values[3 * index + c]; };
      if (this.mode === "opening") {
        const m = this.jointNodes.length;
        for (let i = 0; i < this.n; ++i) set(i, OPENING_COLOURS, 0);
        for (let j = 0; j < m; ++j)
          set(this.jointNodes[j], OPENING_COLOURS, Math.round((1 - w) * this.opening[m * k + j] + w * this.opening[m * (k + next) + j]));
      } else {
        const now = this[this.mode], a = this.mode === "envelope" ? 0 : this.n * k, b = this.mode === "envelope" ? 0 : a + this.n * next;
        const values = this.mode === "pressure" ? PRESSURE_COLOURS : STRESS_COLOURS;
        for (let i = 0; i < this.n; ++i) set(i, values, Math.round((1 - w) * now[a + i] + w * now[b + i]));
      }
      this.colour.needsUpdate = true;
    }

    // Dots along the edges of the chosen joint: a line as wide as WebGL does not draw it.
    mark() {
      const x = this.position.array, places = [];
      for (let e = 0; e < this.edgeJoints.length; ++e) {
        if (this.joint < 1 || this.edgeJoints[e] !== this.joint) continue;
        const [a, b] = [0, 1].map((end) => x.subarray(3 * this.edges[2 * e + end], 3 * this.edges[2 * e + end] + 3));
        const parts = Math.ceil(400 * Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) / this.size);
        for (let t = 0; t <= parts; ++t)
          for (let c = 0; c < 3; ++c) places.push(a[c] + t / parts * (b[c] - a[c]));
      }
      this.selected.visible = places.length > 0;
      this.selected.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(places), 3));
    }

    draw() {
      if (this.waits) return;
      this.waits = true;
      requestAnimationFrame(() => {
        this.waits = false;
        this.renderer.render(this.scene, this.camera);
        ++this.drawn;
      });
    }

    // The joint nearest to a place of the page, or 0 beside the dam.
    jointAt(clientX, clientY) {
      const box = this.canvas.getBoundingClientRect(), ray = new THREE.Raycaster(), best = {joint: 0, distance: Infinity};
      ray.setFromCamera(new THREE.Vector2(2 * (clientX - box.left) / box.width - 1, 1 - 2 * (clientY - box.top) / box.height), this.camera);
      this.surface.geometry.computeBoundingSphere();
      const hits = ray.intersectObject(this.surface);
      if (!hits.length) return 0;
      const p = hits[0].point, x = this.position.array;
      this.jointNodes.forEach((node, j) => {
        const distance = Math.hypot(x[3 * node] - p.x, x[3 * node + 1] - p.y, x[3 * node + 2] - p.z);
        if (distance < best.distance) Object.assign(best, {joint: this.nodeJoints[j], distance: distance});
      });
      return best.joint;
    }

    // Place of the top of a joint on the stage, in CSS pixels.
    topOf(joint) {
      const x = this.position.array, top = new THREE.Vector3(0, 0, -Infinity);
      this.jointNodes.forEach((node, j) => {
        if (this.nodeJoints[j] === joint && x[3 * node + 2] > top.z) top.set(x[3 * node], x[3 * node + 1], x[3 * node + 2]);
      });
      this.camera.updateMatrixWorld();
      top.project(this.camera);
      return {x: (top.x + 1) / 2 * this.stage.clientWidth, y: (1 - top.y) / 2 * this.stage.clientHeight};
    }
  }

  // ---------------------------------------------------------------- histories

  // A plot over time of columns of numbers [mm]; a drag zooms, a double click shows all. Values at the pointer stand in its heading.
  class Plot {
    constructor(parent, labels, colours, frames, onTime) {
      const box = element(parent, "div", "view3d-plot");
      this.heading = element(box, "p", "view3d-heading");
      this.labels = labels;
      this.colours = colours;
      this.place = element(box, "div", "view3d-graph");
      this.time = 0;
      this.frames = frames; // times of the first and the last frame
      this.onTime = onTime;
    }

    show(title, time, columns) {
      const rows = Array.from(time, (t, i) => [t, ...columns.map((column) => column[i])]);
      let top = 0;
      columns.forEach((column) => column.forEach((value) => { top = Math.max(top, Math.abs(value)); }));
      this.title = title;
      this.digits = digitsOf(top);
      this.last = rows;
      if (this.graph) {
        this.graph.updateOptions({file: rows});
      } else {
        this.graph = new Dygraph(this.place, rows, {
          labels: ["time", ...this.labels], colors: this.colours, strokeWidth: 1.2, legend: "never", axisLabelFontSize: 11, gridLineColor: "#e3e7eb",
          axisLineColor: "#9aa3ac", rightGap: 14, xRangePad: 0, highlightCircleSize: 3.5, animatedZooms: false,
          axes: {y: {axisLabelWidth: 40, pixelsPerLabel: 28, axisLabelFormatter: (value) => shown(value, value % 1 ? 1 : 0)}, x: {pixelsPerLabel: 60, axisLabelFormatter: (value) => `${shown(value, value % 1 ? 1 : 0)} s`}},
          highlightCallback: (event, x, points, row) => this.tell(row),
          unhighlightCallback: () => this.tell(-1),
          clickCallback: (event, x) => this.onTime(x),
          underlayCallback: (canvas, area, graph) => {
            const x = graph.toDomXCoord(this.time), [low, high] = this.frames.map((t) => Math.min(Math.max(graph.toDomXCoord(t), area.x), area.x + area.w));
            canvas.fillStyle = "#eff4fa";
            canvas.fillRect(low, area.y, high - low, area.h);
            if (x < area.x || x > area.x + area.w) return;
            canvas.fillStyle = INK;
            canvas.fillRect(x - 0.5, area.y, 1, area.h);
          }});
        this.graph.ready(() => this.tell(-1));
      }
      this.tell(-1);
    }

    tell(row) {
      this.heading.textContent = "";
      element(this.heading, "b", "", this.title);
      const now = row >= 0 && this.last[row] ? this.last[row] : null;
      if (now) element(this.heading, "span", "", `t = ${shown(now[0], 2)} s`);
      this.labels.forEach((label, i) => {
        const span = element(this.heading, "span", "", label + (now ? ` ${shown(now[i + 1], this.digits)}` : ""));
        span.style.color = this.colours[i];
      });
    }

    at(time) {
      this.time = time;
      if (this.graph) this.graph.updateOptions({}, false);
    }
  }

  // ---------------------------------------------------------------- a figure

  class View {
    constructor(figure, data) {
      this.data = data;
      this.live = figure.querySelector(".view3d-live");
      this.stage = element(this.live, "div", "view3d-stage");
      figure.classList.add("view3d-on");
      this.model = new Model(this.stage, data);
      this.label = element(this.stage, "span", "view3d-label");
      this.label.hidden = true; // until a joint is chosen
      this.bar = element(this.stage, "div", "view3d-bar");
      this.makeControls();
      this.makePlots();
      this.makePointer();
      this.colourBar();
      this.show(data.start);
      this.choose(this.worst());
      new ResizeObserver(() => this.model.resize()).observe(this.stage);
      this.model.controls.addEventListener("change", () => this.place());
      figure.view = this;
    }

    makeControls() {
      const {data, model} = this, time = element(this.live, "div", "view3d-row view3d-time"), row = element(this.live, "div", "view3d-row");
      this.button = element(time, "button", "view3d-play", "\u25b6");
      this.button.type = "button";
      this.button.setAttribute("aria-label", "play");
      this.slider = element(time, "input", "view3d-slider");
      Object.assign(this.slider, {type: "range", min: 0, max: data.times.length - 1, step: 1});
      this.slider.setAttribute("aria-label", "time");
      this.now = element(time, "output", "view3d-now");
      time.hidden = data.times.length < 2;
      this.button.addEventListener("click", () => this.play(!this.playing));
      this.slider.addEventListener("input", () => { this.play(false); this.show(Number(this.slider.value)); });
      const select = (name, choices, value, action) => {
        const label = element(row, "label", "view3d-choice", `${name} `), made = element(label, "select");
        choices.forEach(([key, text]) => { element(made, "option", "", text).value = key; });
        made.value = value;
        made.addEventListener("change", () => action(made.value));
        return made;
      };
      const modes = [["stress", "principal stress"], ["envelope", "largest stress over time"], ["opening", "opening of the joints"],
        ["pressure", "dynamic water pressure"]];
      this.modes = select("colour", modes.filter(([key]) => model[key] && (key !== "opening" || data.openingTop > 0)), model.mode, (mode) => {
        const turns = (mode === "pressure") !== (model.mode === "pressure");
        model.mode = mode;
        if (turns) model.look();
        this.colourBar();
        model.update();
      });
      this.joints = select("joint", Object.keys(data.history.joints).map((joint) => [joint, nameOf(data, joint).replace(/^joint /, "")]), "", (joint) => this.choose(Number(joint)));
      this.joints.parentNode.hidden = this.joints.options.length === 0;
      this.speed = select("speed", SPEEDS, 0.25, () => {});
      this.speed.parentNode.hidden = time.hidden;
      const label = element(row, "label", "view3d-choice", "displacements "), factor = this.factor = element(label, "input", "view3d-factor");
      this.times = element(label, "output", "");
      Object.assign(factor, {type: "range", min: 0, max: Math.log10(data.factor) + 1, step: 0.01, value: Math.log10(data.factor)});
      factor.addEventListener("input", () => this.magnify(10 ** Number(factor.value)));
      const reset = element(row, "button", "view3d-reset", "reset view");
      reset.type = "button";
      reset.addEventListener("click", () => { this.magnify(data.factor); factor.value = Math.log10(data.factor); model.look(); });
      this.magnify(data.factor);
    }

    magnify(factor) {
      this.model.factor = Number(factor.toPrecision(2));
      this.times.textContent = `\u00d7 ${this.model.factor}`;
      this.factor.setAttribute("aria-valuetext", `times ${this.model.factor}`);
      this.model.keepInside();
      this.model.update();
      this.place();
    }

    makePlots() {
      const {history} = this.data, go = (time) => { this.play(false); this.show(this.frameAt(time)); };
      const {times} = this.data, frames = [times[0], times[times.length - 1]];
      this.plots = [];
      if (Object.keys(history.joints).length) {
        const pair = element(this.live, "div", "view3d-plots");
        this.opening = new Plot(pair, ["upstream", "downstream"], [UPSTREAM, DOWNSTREAM], frames, go);
        this.slip = new Plot(pair, ["upstream", "downstream"], [UPSTREAM, DOWNSTREAM], frames, go);
        this.plots.push(this.opening, this.slip);
        this.time = numbers(history.time, "f4");
      }
      if (history.crest) {
        const crest = new Plot(this.live, ["downstream positive"], [UPSTREAM], frames, go);
        crest.show("Displacement of the crest [mm]", numbers(history.crest.time, "f4"), [values(history.crest)]);
        this.plots.push(crest);
      }
      const plots = this.plots.length ? " Plots: drag to zoom, double click for all, click to go to a time; shaded: the times of the view." : "";
      element(this.live, "p", "view3d-help", `Turn: drag, or arrow keys. Zoom: wheel or two fingers, after a click, or + and \u2212.${plots}`);
    }

    // A click without a drag chooses a joint.
    makePointer() {
      const {canvas, controls} = this.model;
      const keys = {ArrowLeft: [-0.1, 0, 1], ArrowRight: [0.1, 0, 1], ArrowUp: [0, 0.1, 1], ArrowDown: [0, -0.1, 1], "+": [0, 0, 0.9], "-": [0, 0, 1 / 0.9]};
      canvas.tabIndex = 0;
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", "View of the dam. Arrow keys turn it, plus and minus zoom, Home resets the view.");
      canvas.addEventListener("keydown", (event) => {
        if (event.key === "Home") this.model.look();
        else if (keys[event.key]) this.model.turn(...keys[event.key]);
        else return;
        event.preventDefault();
        this.place();
      });
      let down = null;
      const begin = (event) => { controls.enableZoom = true; down = [event.clientX, event.clientY]; };
      this.stage.addEventListener("pointerdown", begin, true);
      this.stage.addEventListener("mouseleave", () => { controls.enableZoom = false; });
      canvas.addEventListener("pointerup", (event) => {
        if (down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 5) {
          const joint = this.model.jointAt(event.clientX, event.clientY);
          if (joint) this.choose(joint);
        }
        down = null;
      });
    }

    // The joint that opens most.
    worst() {
      const largest = ([, columns]) => Math.max(...["opening_upstream", "opening_downstream"].map((name) => values(columns[name]).reduce((a, b) => Math.max(a, b), 0)));
      const joints = Object.entries(this.data.history.joints).sort((a, b) => largest(b) - largest(a));
      return joints.length ? Number(joints[0][0]) : 0;
    }

    choose(joint) {
      const columns = this.data.history.joints[joint];
      if (!columns) return;
      this.model.joint = joint;
      this.joints.value = String(joint);
      const name = nameOf(this.data, joint);
      for (const [plot, quantity] of [[this.opening, "opening"], [this.slip, "slip"]])
        plot.show(`${name[0].toUpperCase() + name.slice(1)}: ${quantity}${name.startsWith("joint ") ? " at the crest" : ""} [mm]`, this.time, ["upstream", "downstream"].map((face) => values(columns[`${quantity}_${face}`])));
      this.label.textContent = name;
      this.model.update();
      this.place();
    }

    // The label beside the top of the joint.
    place() {
      if (!this.label || !this.model.joint) return;
      const {x, y} = this.model.topOf(this.model.joint), {clientWidth, clientHeight} = this.stage;
      this.label.hidden = x < 0 || x > clientWidth || y < 0 || y > clientHeight;
      this.label.style.left = `${x}px`;
      this.label.style.top = `${Math.max(18, y - 8)}px`;
    }

    frameAt(time) {
      const {times} = this.data;
      let best = 0;
      times.forEach((t, k) => { if (Math.abs(t - time) < Math.abs(times[best] - time)) best = k; });
      return best;
    }

    // A frame, or a time between two: 1.5 is between the second and the third.
    show(at) {
      const {times} = this.data, k = Math.min(Math.floor(at), times.length - 1), w = at - k;
      const time = k + 1 < times.length ? times[k] + w * (times[k + 1] - times[k]) : times[k];
      this.model.at = at;
      this.slider.value = Math.round(at);
      this.now.textContent = `${shown(time, 2)} s`;
      this.slider.setAttribute("aria-valuetext", `${shown(time, 2)} s`);
      this.model.update();
      this.plots.forEach((plot) => plot.at(time));
      this.place();
    }

    play(playing) {
      this.playing = playing;
      this.button.textContent = playing ? "\u275a\u275a" : "\u25b6";
      this.button.setAttribute("aria-label", playing ? "stop" : "play");
      if (!playing) return;
      const {times} = this.data, last = times.length - 1;
      let before = null, at = this.model.at >= last ? 0 : this.model.at;
      const step = (now) => {
        if (!this.playing) return;
        const seconds = before === null ? 0 : (now - before) / 1000 * Number(this.speed.value), k = Math.min(Math.floor(at), last - 1);
        before = now;
        at += seconds / (times[k + 1] - times[k]);
        if (at >= last) at = 0; // again
        this.show(at);
        requestAnimationFrame(step);
      };
      requestAnimationFrame(step);
    }

    colourBar() {
      const {data} = this, opening = this.model.mode === "opening";
      const [name, colours, top, digits] = opening ? ["opening [mm]", OPENING_COLOURS, data.openingTop, digitsOf(data.openingTop)]
        : this.model.mode === "pressure" ? ["dynamic water pressure [MPa]", PRESSURE_COLOURS, data.pressureTop, data.pressureTop < 0.1 ? 4 : 2]
        : ["maximum principal stress [MPa]", STRESS_COLOURS, data.stressTop, digitsOf(data.stressTop) - 1];
      this.bar.textContent = "";
      element(this.bar, "span", "view3d-unit", name);
      const strip = element(this.bar, "canvas", "");
      strip.width = 256;
      strip.height = 1;
      const context = strip.getContext("2d");
      for (let i = 0; i < 256; ++i) {
        context.fillStyle = `rgb(${[0, 1, 2].map((c) => Math.round(255 * colours[3 * i + c])).join(",")})`;
        context.fillRect(i, 0, 1, 1);
      }
      const ends = element(this.bar, "div", "view3d-ends");
      for (const value of opening ? [0, top / 2, top] : [-top, 0, top]) element(ends, "span", "", shown(value, value === 0 ? 0 : Math.max(0, digits)));
    }
  }

  const hasWebGL = () => ["webgl2", "webgl"].some((kind) => document.createElement("canvas").getContext(kind));
  if (window.THREE && window.Dygraph && window.DecompressionStream && hasWebGL()) { // otherwise the picture stays
    // The legend of dygraphs writes style attributes, which the policy of the page forbids; the headings have the values.
    Dygraph.PLUGINS = Dygraph.PLUGINS.filter((plugin) => plugin !== Dygraph.Plugins.Legend);
    document.querySelectorAll("figure.view3d").forEach((figure) => {
      const data = figure.querySelector('script[type="application/json"]');
      if (data) unpacked(JSON.parse(data.textContent)).then((numbers) => new View(figure, numbers));
    });
  }
})();
