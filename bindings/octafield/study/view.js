// Lines in space on a canvas, turned by dragging, scaled by the wheel: <canvas class="view" data-scene="ID"> with the JSON of
// scenes.py in <script type="application/json" id="ID">.
document.querySelectorAll("canvas.view").forEach(canvas => {
  const scene = JSON.parse(document.getElementById(canvas.dataset.scene).textContent);
  const colours = { "surface": "#7b8794", "valence 3": "#D55E00", "valence 5": "#0072B2", "other": "#AA4499" };
  const middle = scene.size.map(s => s / 2), radius = Math.hypot(...middle);
  let turn = [0.6, 0.35], zoom = 1, drag = null;
  const draw = () => {
    const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
    canvas.width = width * ratio; canvas.height = height * ratio;
    const pen = canvas.getContext("2d"), [a, b] = turn, scale = zoom * 0.92 * Math.min(width, height) / 2 / radius;
    pen.scale(ratio, ratio); pen.lineJoin = "round";
    const [ca, sa, cb, sb] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b)];
    for (const [kind, lines] of Object.entries(scene.lines)) {
      pen.strokeStyle = colours[kind]; pen.lineWidth = kind === "surface" ? 0.8 : 2.2; pen.globalAlpha = kind === "surface" ? 0.55 : 1;
      pen.beginPath();
      for (const line of lines) for (let k = 0; k < line.length; k += 3) {
        const x = line[k] - middle[0], y = line[k + 1] - middle[1], z = line[k + 2] - middle[2];
        const u = ca * x - sa * y, v = sb * (sa * x + ca * y) + cb * z;
        pen[k ? "lineTo" : "moveTo"](width / 2 + scale * u, height / 2 - scale * v);
      }
      pen.stroke();
    }
  };
  canvas.addEventListener("pointerdown", e => { drag = [e.clientX, e.clientY, ...turn]; canvas.setPointerCapture(e.pointerId); });
  canvas.addEventListener("pointerup", () => { drag = null; });
  canvas.addEventListener("pointermove", e => {
    if (!drag) return;
    turn = [drag[2] - (e.clientX - drag[0]) / 150, Math.max(-1.57, Math.min(1.57, drag[3] + (e.clientY - drag[1]) / 150))];
    draw();
  });
  canvas.addEventListener("wheel", e => { e.preventDefault(); zoom *= Math.exp(-e.deltaY / 500); draw(); }, { passive: false });
  new IntersectionObserver(seen => { if (seen.some(s => s.isIntersecting)) draw(); }).observe(canvas);
  window.addEventListener("resize", draw);
});
