// The three-dimensional view: skin with its pressure or garment with its tension; turn, zoom, pick a node.
(function () {
  "use strict";
  const $ = (id) => document.getElementById(id);
  const data = JSON.parse($("surfaces").textContent);
  const unpack = (text, Type) => new Type(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
  const reals = (text) => unpack(text, Float32Array), integers = (text) => unpack(text, Int32Array);

  const canvas = $("canvas");
  $("viewer").hidden = false;
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({ canvas: canvas, antialias: true, preserveDrawingBuffer: true });
  } catch (error) {
    $("viewer").hidden = true;
    $("no-webgl").hidden = false;
    return;
  }
  renderer.setPixelRatio(window.devicePixelRatio || 1);
  renderer.setClearColor(0xffffff);
  const scene = new THREE.Scene();
  scene.add(new THREE.AmbientLight(0xffffff, 0.78));
  const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.01, 100);
  camera.up.set(0, 0, 1);
  const lamp = new THREE.DirectionalLight(0xffffff, 0.32);
  camera.add(lamp);
  scene.add(camera);

  // A colour a value: the scalar is interpolated, then looked up. The first entry is for skin that bears nothing.
  const bare = [0xec, 0xee, 0xf0], entries = 512;
  function colourAt(t) {
    const at = Math.min(Math.max(t, 0), 1) * (data.colours.length - 1), i = Math.min(Math.floor(at), data.colours.length - 2);
    return [16, 8, 0].map((shift) => {
      const a = (data.colours[i] >> shift) & 255, b = (data.colours[i + 1] >> shift) & 255;
      return Math.round(a + (b - a) * (at - i));
    });
  }
  function lookup(first) {
    const texels = new Uint8Array(4 * entries);
    for (let i = 0; i < entries; ++i) texels.set([...(i === 0 && first ? first : colourAt(i / (entries - 1))), 255], 4 * i);
    const texture = new THREE.DataTexture(texels, entries, 1, THREE.RGBAFormat);
    texture.needsUpdate = true;
    return texture;
  }
  function coloured(positions, index, values, top, first) {
    const geometry = new THREE.BufferGeometry(), uv = new Float32Array(2 * values.length);
    values.forEach((value, n) => uv.set([(Math.min(Math.max(value / top, 0), 1) * (entries - 1) + 0.5) / entries, 0.5], 2 * n));
    geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
    geometry.setAttribute("uv", new THREE.BufferAttribute(uv, 2));
    if (index) geometry.setIndex(new THREE.BufferAttribute(Uint32Array.from(index), 1));
    geometry.computeVertexNormals();
    const material = new THREE.MeshLambertMaterial({ map: lookup(first), side: THREE.DoubleSide });
    return new THREE.Mesh(geometry, material);
  }

  function makeSkin(given) {
    const skin = { numbers: integers(given.numbers), nodes: reals(given.nodes), displacement: reals(given.displacement),
      pressure: reals(given.pressure), location: integers(given.location), locations: given.locations };
    skin.mesh = coloured(new Float32Array(skin.nodes.length), integers(given.triangles), skin.pressure, data.top, bare);
    skin.mesh.material.polygonOffset = true;  // behind the lines and the garment that lie on it
    skin.mesh.material.polygonOffsetFactor = 1;
    skin.mesh.material.polygonOffsetUnits = 40000;
    skin.plain = new THREE.MeshLambertMaterial({ color: 0xe4e1de, side: THREE.DoubleSide, polygonOffset: true,
      polygonOffsetFactor: 1, polygonOffsetUnits: 80000 });
    skin.coloured = skin.mesh.material;
    skin.warp = function (factor) {
      const positions = skin.mesh.geometry.attributes.position;
      for (let i = 0; i < skin.nodes.length; ++i) positions.array[i] = skin.nodes[i] + factor * skin.displacement[i];
      positions.needsUpdate = true;
      skin.mesh.geometry.computeVertexNormals();
      skin.mesh.geometry.computeBoundingSphere();
    };
    skin.warp(1);
    return skin;
  }

  // Edges of one triangle only, where a seam's two rows of nodes count as one: the hems.
  function hems(nodes, triangles) {
    const key = (n) => [0, 1, 2].map((c) => Math.round(nodes[3 * n + c] * 1e5)).join();
    const edges = new Map();
    for (let t = 0; t < triangles.length; t += 3)
      for (let i = 0; i < 3; ++i) {
        const ends = [triangles[t + i], triangles[t + (i + 1) % 3]], name = ends.map(key).sort().join(";");
        edges.has(name) ? edges.delete(name) : edges.set(name, ends);
      }
    const points = [];
    edges.forEach((ends) => ends.forEach((n) => points.push(nodes[3 * n], nodes[3 * n + 1], nodes[3 * n + 2])));
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(points), 3));
    return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: 0x1b1f24 }));
  }
  function makeGarment(given) {
    const nodes = reals(given.nodes), triangles = integers(given.triangles);
    const garment = { warp: reals(given.warp), weft: reals(given.weft), wrinkled: reals(given.wrinkled) };
    const most = (values) => values.reduce((a, b) => Math.max(a, b), 0);
    garment.name = most(garment.warp) > most(garment.weft) ? "warp" : "weft";  // the threads that carry
    const tension = garment[garment.name], step = Math.pow(10, Math.floor(Math.log10(most(tension) || 1)));
    garment.top = Math.ceil((most(tension) || 1) / step - 1e-9) * step;
    const positions = new Float32Array(3 * triangles.length), values = new Float32Array(triangles.length);
    triangles.forEach((n, corner) => {
      positions.set(nodes.subarray(3 * n, 3 * n + 3), 3 * corner);
      values[corner] = tension[Math.floor(corner / 3)];
    });
    garment.mesh = coloured(positions, null, values, garment.top, null);
    garment.mesh.visible = false;
    garment.hems = hems(nodes, triangles);
    return garment;
  }

  const pressed_skin = data.skin && !data.shape_only;  // particles tell no pressures of the skin
  const skin = data.skin && makeSkin(data.skin), garment = data.garment && makeGarment(data.garment);
  if (skin) scene.add(skin.mesh);
  if (garment) scene.add(garment.mesh, garment.hems);
  const marker = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial({ color: 0xd01c1c, size: 9,
    sizeAttenuation: false, depthTest: false }));
  marker.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3), 3));
  marker.visible = false;
  marker.frustumCulled = false;
  scene.add(marker);

  const sphere = [skin, garment].filter(Boolean).reduce((box, part) => box.expandByObject(part.mesh), new THREE.Box3()).getBoundingSphere(new THREE.Sphere());
  const controls = new THREE.OrbitControls(camera, canvas);
  controls.target.copy(sphere.center);
  camera.near = sphere.radius;
  camera.far = 7 * sphere.radius;
  const render = () => renderer.render(scene, camera);
  controls.addEventListener("change", render);

  function resize() {
    const width = canvas.parentElement.clientWidth, height = canvas.parentElement.clientHeight;
    renderer.setSize(width, height, false);
    const half = 1.04 * sphere.radius * Math.max(1, height / width);
    camera.top = half, camera.bottom = -half;
    camera.right = half * width / height, camera.left = -camera.right;
    camera.updateProjectionMatrix();
    render();
  }
  function lookFrom(direction) {
    camera.position.copy(direction).normalize().multiplyScalar(4 * sphere.radius).add(sphere.center);
    camera.zoom = 1;
    camera.updateProjectionMatrix();
    controls.target.copy(sphere.center);
    controls.update();
    render();
  }

  function showBar(top, unit, title) {
    const stops = [];
    for (let i = 0; i <= 20; ++i) stops.push("rgb(" + colourAt(1 - i / 20).join() + ")");
    const bar = $("bar");
    bar.style.background = "linear-gradient(" + stops.join() + ")";
    bar.innerHTML = "";
    const add = (tag, text, place) => Object.assign(bar.appendChild(document.createElement(tag)), { textContent: text }).style.top = place;
    add("b", title + " [" + unit + "]", "");
    const least = top / 5, power = Math.pow(10, Math.floor(Math.log10(least)));
    const step = [1, 2, 2.5, 5, 10].map((s) => s * power).find((s) => s >= least * (1 - 1e-9));
    for (let value = 0; value <= top * (1 + 1e-9); value += step) add("span", String(+value.toPrecision(4)), 100 * (1 - value / top) + "%");
  }
  function show(what) {
    const tension = what === "garment";
    if (garment) garment.mesh.visible = tension;
    if (skin) skin.mesh.material = tension ? skin.plain : skin.coloured;
    if (skin) skin.warp(tension ? 1 : Number($("warp").value));
    $("warp").disabled = tension;
    if (tension) showBar(garment.top, "N/m", "tension, " + garment.name);
    else showBar(data.top / data.factor, data.unit, "contact pressure");
    render();
  }

  const shown = (value, digits) => String(+value.toPrecision(digits || 4)).replace("-", "−");
  function say(text, values) {
    const readout = $("readout");
    readout.textContent = text;
    Object.keys(readout.dataset).forEach((key) => delete readout.dataset[key]);
    Object.assign(readout.dataset, values);
  }
  function mark(positions, n) {
    marker.visible = n >= 0;
    if (n >= 0) marker.geometry.attributes.position.array.set(positions.subarray(3 * n, 3 * n + 3));
    marker.geometry.attributes.position.needsUpdate = true;
    render();
  }
  function readNode(n) {
    const at = skin.nodes.subarray(3 * n, 3 * n + 3), u = skin.displacement.subarray(3 * n, 3 * n + 3), p = skin.pressure[n];
    const place = skin.location[n] < 0 ? "" : ", " + skin.locations[skin.location[n]];
    const vector = (v) => Array.from(v, (c) => shown(1e3 * c)).join(", ");
    say("Node " + skin.numbers[n] + place + ": pressure " + shown(p) + " Pa (" + shown(p / 98.0665, 3) + " gf/cm², " +
      shown(p / 133.322387415, 3) + " mmHg); place " + vector(at) + " mm; displacement " + vector(u) + " mm, " +
      shown(1e3 * Math.hypot(u[0], u[1], u[2])) + " mm in all.",
      { node: skin.numbers[n], pressure: p, location: place.slice(2) });
    mark(skin.mesh.geometry.attributes.position.array, n);
  }
  function readTriangle(t) {
    const state = ["taut", "wrinkled", "slack"][Math.round(garment.wrinkled[t])] || "";
    say("Garment: tension " + shown(garment.warp[t]) + " N/m along the warp, " + shown(garment.weft[t]) +
      " N/m along the weft" + (state && "; " + state) + ".", { warp: garment.warp[t], weft: garment.weft[t] });
    mark(garment.mesh.geometry.attributes.position.array, 3 * t);
  }

  const raycaster = new THREE.Raycaster();
  function pick(event) {
    const frame = canvas.getBoundingClientRect();
    raycaster.setFromCamera({ x: (2 * (event.clientX - frame.left)) / frame.width - 1,
      y: 1 - (2 * (event.clientY - frame.top)) / frame.height }, camera);
    const onGarment = garment && garment.mesh.visible, mesh = onGarment ? garment.mesh : skin && skin.mesh;
    const hit = mesh && raycaster.intersectObject(mesh)[0];
    if (!hit) return;
    if (onGarment) return readTriangle(hit.faceIndex);
    const positions = mesh.geometry.attributes.position, corner = new THREE.Vector3();
    const distance = (n) => corner.fromBufferAttribute(positions, n).distanceTo(hit.point);
    readNode([hit.face.a, hit.face.b, hit.face.c].sort((a, b) => distance(a) - distance(b))[0]);
  }
  let pressed = null;
  canvas.addEventListener("mousedown", (event) => (pressed = [event.clientX, event.clientY]));
  canvas.addEventListener("click", (event) => {
    if (pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < 4) pick(event);
  });
  $("node").addEventListener("change", () => {
    const n = skin ? skin.numbers.indexOf(Number($("node").value)) : -1;
    n >= 0 ? readNode(n) : say("There is no node " + $("node").value + " on the skin.", {});
    if (n < 0) mark(null, -1);
  });
  $("warp").addEventListener("change", () => show("skin"));
  document.querySelectorAll("[name=show]").forEach((radio) => {
    radio.addEventListener("change", () => show(radio.value));
    if ((radio.value === "garment" && !garment) || (radio.value === "skin" && !pressed_skin)) radio.disabled = true;
    else if (!pressed_skin) radio.checked = true;
  });
  document.querySelectorAll("[data-from]").forEach((button) => button.addEventListener("click", () =>
    lookFrom(new THREE.Vector3(...button.dataset.from.split(" ").map(Number)))));
  window.addEventListener("resize", resize);

  show(pressed_skin ? "skin" : "garment");
  resize();
  lookFrom(new THREE.Vector3(0.6, 1, 0.35));
})();
