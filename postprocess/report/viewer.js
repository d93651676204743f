// SPDX-License-Identifier: Apache-2.0
// Interactive view of a run: bodies instanced per shape, orbit and zoom by pointer, a slider over the snapshots.
// Plain WebGL 2, no library. The scene is in the page as JSON; see report/viewer_scene.h for its layout.
(function () {
  "use strict";
  const canvas = document.getElementById("viewer");
  const note = document.getElementById("viewer-note");
  const scene = JSON.parse(document.getElementById("viewer-scene").textContent);
  const gl = canvas.getContext("webgl2", {antialias: true, alpha: false});
  if (!gl) {
    note.textContent = "This browser has no WebGL 2, so the interactive view is off. The pictures above show the same run.";
    canvas.style.display = "none";
    document.getElementById("viewer-controls").style.display = "none";
    return;
  }

  function bytes(text) {
    const raw = atob(text), out = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; ++i) out[i] = raw.charCodeAt(i);
    return out;
  }
  const int16 = text => new Int16Array(bytes(text).buffer);
  const uint16 = text => new Uint16Array(bytes(text).buffer);
  const uint32 = text => new Uint32Array(bytes(text).buffer);
  const float32 = text => new Float32Array(bytes(text).buffer);

  // ---- Shaders: faces are shaded flat from screen-space derivatives, so that no normals need to be sent.
  const vertexSource = `#version 300 es
    layout(location=0) in vec3 corner; layout(location=1) in vec4 place; layout(location=2) in vec4 turn;
    layout(location=3) in float value;
    uniform mat4 view, projection; uniform float radius;
    out vec3 eyePoint; out vec3 eyeNormal; out float tint;
    void main() {
      vec3 p = corner * radius * place.w;
      vec3 q = p + 2.0 * cross(turn.xyz, cross(turn.xyz, p) + turn.w * p);
      vec4 seen = view * vec4(q + place.xyz, 1.0);
      eyePoint = seen.xyz; eyeNormal = mat3(view) * q; tint = value;
      gl_Position = projection * seen;
    }`;
  const fragmentSource = `#version 300 es
    precision highp float;
    in vec3 eyePoint; in vec3 eyeNormal; in float tint;
    uniform vec4 colour; uniform bool isRound;
    out vec4 pixel;
    vec3 speedColour(float t) {
      vec3 c = mix(vec3(.80,.775,.72), vec3(.88,.78,.56), clamp(t/.15,0.,1.));
      c = mix(c, vec3(.93,.67,.30), clamp((t-.15)/.20,0.,1.));
      c = mix(c, vec3(.87,.42,.17), clamp((t-.35)/.25,0.,1.));
      c = mix(c, vec3(.70,.18,.15), clamp((t-.60)/.22,0.,1.));
      return mix(c, vec3(.44,.05,.14), clamp((t-.82)/.18,0.,1.));
    }
    void main() {
      vec3 n = isRound ? normalize(eyeNormal) : normalize(cross(dFdx(eyePoint), dFdy(eyePoint)));
      if (dot(n, eyePoint) > 0.0) n = -n;
      float light = 0.34 + 0.55 * max(0.0, dot(n, normalize(vec3(-.45,.75,.6)))) + 0.2 * max(0.0, n.z);
      vec3 base = colour.a < 0.0 ? speedColour(tint) : colour.rgb;
      pixel = vec4(base * light, abs(colour.a));
    }`;
  function compiled(type, source) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    return shader;
  }
  const program = gl.createProgram();
  gl.attachShader(program, compiled(gl.VERTEX_SHADER, vertexSource));
  gl.attachShader(program, compiled(gl.FRAGMENT_SHADER, fragmentSource));
  gl.linkProgram(program);
  gl.useProgram(program);
  const uniform = name => gl.getUniformLocation(program, name);
  const uView = uniform("view"), uProjection = uniform("projection"), uRadius = uniform("radius");
  const uColour = uniform("colour"), uRound = uniform("isRound");

  // ---- Meshes: one per shape and one per wall, each with a buffer of instances (place, scale, turn, value).
  function mesh(part) {
    const vao = gl.createVertexArray(), instances = gl.createBuffer();
    gl.bindVertexArray(vao);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, int16(part.corners), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.SHORT, true, 0, 0);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    const triangles = uint32(part.triangles);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
    gl.bindBuffer(gl.ARRAY_BUFFER, instances);
    [[1, 4, 0], [2, 4, 16], [3, 1, 32]].forEach(([location, size, offset]) => {
      gl.enableVertexAttribArray(location);
      gl.vertexAttribPointer(location, size, gl.FLOAT, false, 36, offset);
      gl.vertexAttribDivisor(location, 1);
    });
    return {vao, instances, radius: part.radius, isRound: part.round, indices: triangles.length, count: 0};
  }
  function fill(target, values, count) {
    gl.bindBuffer(gl.ARRAY_BUFFER, target.instances);
    gl.bufferData(gl.ARRAY_BUFFER, values.subarray(0, 9 * count), gl.DYNAMIC_DRAW);
    target.count = count;
  }
  function draw(target, colour) {
    if (target.count === 0) return;
    gl.bindVertexArray(target.vao);
    gl.uniform1f(uRadius, target.radius);
    gl.uniform1i(uRound, target.isRound ? 1 : 0);
    gl.uniform4fv(uColour, colour);
    gl.drawElementsInstanced(gl.TRIANGLES, target.indices, gl.UNSIGNED_INT, 0, target.count);
  }
  const shapes = scene.shapes.map(mesh), walls = scene.walls.map(mesh);
  const shapeOf = uint16(scene.shapeOf), scaleOf = float32(scene.scaleOf);
  const bodyCount = shapeOf.length, low = scene.low, span = scene.span;

  function showFrame(index) {
    const frame = scene.frames[index];
    const place = uint16(frame.place), turn = int16(frame.turn), speed = bytes(frame.speed);
    shapes.forEach((shape, s) => {
      const values = new Float32Array(9 * bodyCount);
      let count = 0;
      for (let b = 0; b < bodyCount; ++b) {
        if (shapeOf[b] !== s || speed[b] === 255) continue;  // 255: has left
        const at = 9 * count++;
        for (let k = 0; k < 3; ++k) values[at + k] = low[k] + span[k] * place[3 * b + k] / 65535;
        values[at + 3] = scaleOf[b];
        for (let k = 0; k < 4; ++k) values[at + 4 + k] = turn[4 * b + k] / 32767;
        values[at + 8] = speed[b] / 254;
      }
      fill(shape, values, count);
    });
    const wallPlace = float32(frame.walls);
    walls.forEach((wall, w) => {
      const values = new Float32Array(9);
      values.set([wallPlace[8 * w], wallPlace[8 * w + 1], wallPlace[8 * w + 2], 1]);
      values.set(wallPlace.subarray(8 * w + 3, 8 * w + 7), 4);
      fill(wall, values, wallPlace[8 * w + 7] > 0 ? 1 : 0);
    });
    document.getElementById("viewer-time").textContent = "t = " + frame.time.toFixed(3) + " s";
    redraw();
  }

  // ---- Camera
  const add = (a, b, s) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unit = a => { const l = Math.hypot(a[0], a[1], a[2]) || 1; return [a[0] / l, a[1] / l, a[2] / l]; };
  function rotated(v, axis, angle) {
    const c = Math.cos(angle), s = Math.sin(angle);
    return add(add([v[0] * c, v[1] * c, v[2] * c], cross(axis, v), s), axis, dot(axis, v) * (1 - c));
  }
  let focus, arm, up;
  function reset() {
    focus = scene.focus.slice();
    arm = add(scene.eye, scene.focus, -1);
    up = scene.up.slice();
  }
  function turnBy(dx, dy) {
    arm = rotated(arm, scene.vertical, -dx);
    up = rotated(up, scene.vertical, -dx);
    const right = unit(cross(up, arm));
    const next = rotated(arm, right, -dy);
    if (Math.abs(dot(unit(next), scene.vertical)) < 0.995) { arm = next; up = rotated(up, right, -dy); }
  }
  let isScheduled = false;
  function redraw() {
    if (!isScheduled) { isScheduled = true; requestAnimationFrame(render); }
  }
  function render() {
    isScheduled = false;
    const ratio = window.devicePixelRatio || 1;
    canvas.width = Math.round(canvas.clientWidth * ratio);
    canvas.height = Math.round(canvas.clientHeight * ratio);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0.97, 0.975, 0.98, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    const eye = add(focus, arm, 1), z = unit(arm), x = unit(cross(up, z)), y = cross(z, x);
    gl.uniformMatrix4fv(uView, false, [x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0,
      -dot(x, eye), -dot(y, eye), -dot(z, eye), 1]);
    const f = 1 / Math.tan(scene.angle * Math.PI / 360), reach = Math.hypot(arm[0], arm[1], arm[2]);
    const size = Math.hypot(span[0], span[1], span[2]);
    const near = Math.max(reach - 3 * size, reach / 100), far = reach + 3 * size;
    gl.uniformMatrix4fv(uProjection, false, [f * canvas.height / canvas.width, 0, 0, 0, 0, f, 0, 0, 0, 0,
      (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0]);
    gl.disable(gl.BLEND);
    gl.depthMask(true);
    shapes.forEach(shape => draw(shape, [0, 0, 0, -1]));
    walls.forEach((wall, w) => { if (scene.walls[w].solid) draw(wall, [0.42, 0.48, 0.53, 1]); });
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    walls.forEach((wall, w) => { if (!scene.walls[w].solid) draw(wall, [0.55, 0.64, 0.72, 0.15]); });
    gl.depthMask(true);
  }

  // ---- Pointer, slider, play
  let held = null;
  canvas.addEventListener("pointerdown", e => {
    held = {x: e.clientX, y: e.clientY, isPan: e.shiftKey || e.button === 2};
    canvas.setPointerCapture(e.pointerId);
  });
  canvas.addEventListener("pointermove", e => {
    if (!held) return;
    const dx = e.clientX - held.x, dy = e.clientY - held.y;
    held.x = e.clientX; held.y = e.clientY;
    if (held.isPan) {
      const scale = 2 * Math.tan(scene.angle * Math.PI / 360) * Math.hypot(arm[0], arm[1], arm[2]) / canvas.clientHeight;
      focus = add(add(focus, unit(cross(up, arm)), -dx * scale), unit(up), dy * scale);
    } else {
      turnBy(dx * 0.008, dy * 0.008);
    }
    redraw();
  });
  ["pointerup", "pointercancel"].forEach(name => canvas.addEventListener(name, () => { held = null; }));
  canvas.addEventListener("contextmenu", e => e.preventDefault());
  canvas.addEventListener("dblclick", () => { reset(); redraw(); });
  canvas.addEventListener("wheel", e => {
    e.preventDefault();
    const factor = Math.exp(Math.max(-0.3, Math.min(0.3, e.deltaY * 0.0012)));
    arm = [arm[0] * factor, arm[1] * factor, arm[2] * factor];
    redraw();
  }, {passive: false});
  window.addEventListener("resize", redraw);
  const slider = document.getElementById("viewer-slider"), play = document.getElementById("viewer-play");
  slider.max = scene.frames.length - 1;
  slider.value = slider.max;
  slider.addEventListener("input", () => showFrame(Number(slider.value)));
  let timer = null;
  play.addEventListener("click", () => {
    play.textContent = timer ? "play" : "stop";
    if (timer) { clearInterval(timer); timer = null; return; }
    timer = setInterval(() => {
      slider.value = (Number(slider.value) + 1) % scene.frames.length;
      showFrame(Number(slider.value));
    }, 120);
  });
  reset();
  showFrame(scene.frames.length - 1);
})();
