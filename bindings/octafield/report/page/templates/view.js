// Lines in space on canvases: <canvas class="view" data-block="ID" data-scene="K"> shows scene K of the block (see scenes.py) in
// <script type="text/plain" id="ID">. Those of one block turn together: by dragging, by arrow keys; + and -, or the wheel after a click, scale.
(() => {
  const colours = { "valence 3": "#D55E00", "valence 5": "#0072B2", "other": "#AA4499" };
  const decode = async text => {
    const packed = Uint8Array.from(atob(text), c => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    const buffer = await new Response(stream).arrayBuffer(), view = new DataView(buffer);
    const length = view.getUint32(0, true), head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
    let at = 4 + length;
    const take = counts => counts.map(count => {
      const line = new Float32Array(3 * count);
      for (let k = 0; k < 3 * count; k++, at += 2) line[k] = view.getInt16(at, true) + (k > 2 ? line[k - 3] : 0);
      return line;
    });
    const outline = take(head.outline);
    const scenes = head.scenes.map(kinds => Object.fromEntries(Object.entries(kinds).map(([kind, counts]) => [kind, take(counts)])));
    return { middle: head.size.map(s => s / 2), outline, scenes };
  };
  const blocks = new Map();
  const blockOf = id => {
    if (!blocks.has(id)) {
      const block = { turn: [0.6, 0.35], zoom: 1, canvases: [], ready: null };
      blocks.set(id, block);
      decode(document.getElementById(id).textContent).then(data => { block.ready = data; redraw(block); });
    }
    return blocks.get(id);
  };
  // size: in place of that on the page, of canvases that are not shown (other inputs' sections are, on paper).
  const draw = (canvas, size = 0) => {
    const block = canvas.block;
    if (!block.ready) return;
    const { middle, outline, scenes } = block.ready;
    const ratio = size ? 2 : window.devicePixelRatio || 1, width = canvas.clientWidth || size, height = canvas.clientHeight || size;
    if (!width) return;
    canvas.width = width * ratio; canvas.height = height * ratio;
    const pen = canvas.getContext("2d"), [a, b] = block.turn, radius = Math.hypot(...middle);
    const scale = block.zoom * 0.92 * Math.min(width, height) / 2 / radius, ink = getComputedStyle(canvas).color;
    pen.scale(ratio, ratio); pen.lineJoin = "round";
    const [ca, sa, cb, sb] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b)];
    const place = (line, k) => {
      const x = line[k] - middle[0], y = line[k + 1] - middle[1], z = line[k + 2] - middle[2], far = sa * x + ca * y;
      return [width / 2 + scale * (ca * x - sa * y), height / 2 - scale * (sb * far + cb * z), (sb * z - cb * far) / radius];
    };
    // In four layers from the back, each stronger than the one behind it.
    const stroke = (lines, colour, thick, weakest) => {
      const layers = [0, 1, 2, 3].map(() => new Path2D());
      for (const line of lines) {
        let last = place(line, 0);
        for (let k = 3; k < line.length; k += 3) {
          const next = place(line, k), layer = layers[Math.max(0, Math.min(3, Math.floor(2 + (last[2] + next[2]))))];
          layer.moveTo(last[0], last[1]); layer.lineTo(next[0], next[1]);
          last = next;
        }
      }
      pen.strokeStyle = colour; pen.lineCap = "round"; pen.lineWidth = thick;
      layers.forEach((layer, k) => { pen.globalAlpha = weakest + (1 - weakest) * k / 3; pen.stroke(layer); });
    };
    stroke(outline, "#7b8794", 0.8, 0.35);
    const scene = scenes[canvas.dataset.scene];
    for (const [kind, colour] of Object.entries(colours)) stroke(scene[kind], colour, 2, 0.6);
    pen.fillStyle = ink; pen.globalAlpha = 1;
    for (const line of scene.nodes) for (let k = 0; k < line.length; k += 3) {
      const [u, v] = place(line, k);
      pen.beginPath(); pen.arc(u, v, 2.2, 0, 7); pen.fill();
    }
  };
  const redraw = block => block.canvases.forEach(canvas => { if (canvas.seen) draw(canvas); });
  const turnBy = (block, x, y) => {
    block.turn = [block.turn[0] + x, Math.max(-1.57, Math.min(1.57, block.turn[1] + y))];
    redraw(block);
  };
  const scaleBy = (block, factor) => { block.zoom = Math.max(0.2, Math.min(40, block.zoom * factor)); redraw(block); };
  const listen = canvas => {
    let drag = null;
    canvas.addEventListener("pointerdown", e => { drag = [e.clientX, e.clientY]; canvas.setPointerCapture(e.pointerId); });
    canvas.addEventListener("pointerup", () => { drag = null; });
    canvas.addEventListener("pointermove", e => {
      if (!drag) return;
      turnBy(canvas.block, -(e.clientX - drag[0]) / 150, (e.clientY - drag[1]) / 150);
      drag = [e.clientX, e.clientY];
    });
    canvas.addEventListener("wheel", e => {
      if (document.activeElement !== canvas) return;
      e.preventDefault(); scaleBy(canvas.block, Math.exp(-e.deltaY / 500));
    }, { passive: false });
    canvas.addEventListener("keydown", e => {
      const steps = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
      if (steps[e.key]) turnBy(canvas.block, ...steps[e.key]);
      else if (e.key === "+" || e.key === "-") scaleBy(canvas.block, e.key === "+" ? 1.2 : 1 / 1.2);
      else return;
      e.preventDefault();
    });
  };
  // All blocks are decoded at once: what is printed may not wait.
  const canvases = [...document.querySelectorAll("canvas.view")];
  canvases.forEach(canvas => {
    canvas.block = blockOf(canvas.dataset.block);
    canvas.block.canvases.push(canvas);
    listen(canvas);
  });
  const observer = new IntersectionObserver(seen => seen.forEach(s => {
    s.target.seen = s.isIntersecting;
    if (s.isIntersecting) draw(s.target);
  }), { rootMargin: "200px" });
  canvases.forEach(canvas => observer.observe(canvas));
  const all = () => blocks.forEach(redraw);
  const paper = () => canvases.forEach(canvas => draw(canvas, 240));
  window.addEventListener("beforeprint", paper);
  window.addEventListener("afterprint", all);
  matchMedia("print").addEventListener("change", print => { if (print.matches) paper(); });
  window.addEventListener("resize", all);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", all);
})();
