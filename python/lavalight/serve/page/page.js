// The page: a model in, a picture out that gets better, and a hand to turn it with.
import { Orbit } from "./orbit.js";

const QUICK_PIXELS = 60_000; // of pictures while the view moves
const QUICK_SAMPLES = 2;
const REST_MILLISECONDS = 200; // without a movement, until the picture is rendered in full
const RETRIES = 5; // of a request that found the queue full

const get = (id) => document.getElementById(id);
const stage = get("stage");
const picture = get("picture");

let about = { limits: { bytes: 64 << 20, pixels: 4 << 20, samples: 4096 } };
let scene = null;
let orbit = null;
let running = null; // the AbortController of the picture under way
let moving = false; // a quick picture is under way
let moved = false; // the view has changed since it began
let restTimer = 0;

/** The server's own words for a failure. */
async function refusalOf(response) {
  const text = (await response.text()).trim();
  return new Error(text || `the server answered with ${response.status}`);
}

function say(text) {
  get("status").textContent = text;
}

function complain(error) {
  const isOurs = error?.name === "AbortError";
  get("error").hidden = isOurs || !error;
  get("error").textContent = error && !isOurs ? (error instanceof TypeError ? "The server cannot be reached." : error.message) : "";
}

const pause = (milliseconds, signal) =>
  new Promise((resolve, reject) => {
    const timer = setTimeout(resolve, milliseconds);
    signal?.addEventListener("abort", () => {
      clearTimeout(timer);
      reject(new DOMException("aborted", "AbortError"));
    });
  });

/** A POST; where the queue is full, again after a while. */
async function post(address, options) {
  for (let attempt = 0; ; ++attempt) {
    const response = await fetch(address, { method: "POST", ...options });
    if (response.ok) return response;
    if (response.status !== 503 || attempt === RETRIES) throw await refusalOf(response);
    say("The server is busy");
    await pause(1000 * Number(response.headers.get("Retry-After") ?? 1), options.signal);
  }
}

// What is asked for.

function sizeWithin(pixels) {
  const ratio = Math.min(2, window.devicePixelRatio || 1);
  const width = Math.max(16, stage.clientWidth * ratio);
  const height = Math.max(16, stage.clientHeight * ratio);
  const scale = Math.min(1, Math.sqrt(pixels / (width * height)));
  return [Math.max(1, Math.floor(width * scale)), Math.max(1, Math.floor(height * scale))];
}

function request() {
  const wanted = { scene: scene.scene, ...orbit.view, exposure: Number(get("exposure").value), tonemap: get("tonemap").value };
  if (get("env").value) wanted.env = get("env").value;
  return wanted;
}

const json = (value, accept, signal) => ({
  body: JSON.stringify(value),
  headers: { "Content-Type": "application/json", Accept: accept },
  signal,
});

// What comes back.

let shown = "";

function show(blob, samples) {
  const address = URL.createObjectURL(blob);
  picture.src = address;
  picture.dataset.samples = samples;
  picture.hidden = false;
  if (shown) URL.revokeObjectURL(shown);
  shown = address;
}

function blobOf(data) {
  return new Blob([Uint8Array.from(atob(data.data), (letter) => letter.charCodeAt(0))], { type: data.type });
}

/** Server-sent events of a response, one by one: EventSource cannot post. */
async function* eventsOf(response) {
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let text = "";
  for (;;) {
    const { value, done } = await reader.read();
    if (done) return;
    text += value;
    const parts = text.split("\n\n");
    text = parts.pop();
    for (const part of parts) {
      const name = /^event: (.*)$/m.exec(part)?.[1];
      const data = /^data: (.*)$/m.exec(part)?.[1];
      if (name && data) yield { name, data: JSON.parse(data) };
    }
  }
}

function showProgress(data) {
  get("progress").hidden = false;
  get("progress").value = data.samples / data.of;
  say(`${data.width} × ${data.height}, ${data.samples} of ${data.of} samples, ${data.seconds.toFixed(1)} s`);
}

function handle(event) {
  if (event.name === "queued") say(event.data.ahead === 1 ? "One picture is before this one" : `${event.data.ahead} pictures are before this one`);
  if (event.name === "error") throw new Error(event.data.message);
  if (event.name === "picture") {
    show(blobOf(event.data), event.data.samples);
    showProgress(event.data);
  }
  if (event.name === "done") {
    get("progress").hidden = true;
    picture.dataset.done = "true";
  }
}

// Two kinds of pictures: small ones at once while the view moves, and one in full when it rests.

async function renderInFull() {
  running?.abort();
  running = new AbortController();
  const { signal } = running;
  delete picture.dataset.done;
  const wanted = {
    ...request(),
    size: sizeWithin(about.limits.pixels),
    spp: Math.min(Number(get("spp").value), about.limits.samples),
    denoise: get("denoise").checked,
    every: 0.5,
  };
  try {
    const response = await post("render", json(wanted, "text/event-stream", signal));
    for await (const event of eventsOf(response)) handle(event);
    complain(null);
  } catch (error) {
    complain(error);
    if (error.name !== "AbortError") get("progress").hidden = true;
  }
}

async function renderQuickly() {
  if (moving) return;
  moving = true;
  running?.abort();
  running = new AbortController();
  const { signal } = running;
  try {
    do {
      moved = false;
      delete picture.dataset.done;
      const wanted = { ...request(), size: sizeWithin(QUICK_PIXELS), spp: QUICK_SAMPLES, format: "jpeg" };
      const response = await post("render", json(wanted, "image/jpeg", signal));
      show(await response.blob(), QUICK_SAMPLES);
      get("progress").hidden = true;
      say("A small picture, until the view rests");
      complain(null);
    } while (moved);
  } catch (error) {
    complain(error);
  } finally {
    moving = false;
  }
}

/** The view has changed. */
function move() {
  if (!scene) return;
  moved = true;
  clearTimeout(restTimer);
  restTimer = setTimeout(renderInFull, REST_MILLISECONDS);
  renderQuickly();
}

// Models.

async function openScene(options, name) {
  running?.abort();
  complain(null);
  say(`Sending ${name}`);
  get("empty").hidden = true;
  get("progress").hidden = false;
  get("progress").removeAttribute("value");
  try {
    const response = await post("scenes", options);
    const former = scene;
    scene = await response.json();
    if (former) fetch(`scenes/${former.scene}`, { method: "DELETE" });
    orbit = new Orbit(scene);
    picture.alt = `A rendering of ${name}; the arrow keys turn it`;
    get("choices").hidden = false;
    document.title = `${name} – Lavalight`;
    say(`${name}, ${scene.triangles.toLocaleString("en")} triangles`);
    await renderInFull();
  } catch (error) {
    complain(error);
    get("progress").hidden = true;
    get("empty").hidden = Boolean(scene);
    say(scene ? "" : "No model");
  }
}

function openFile(file) {
  if (!file) return;
  if (file.size > about.limits.bytes) {
    complain(new Error(`${file.name} is larger than ${Math.floor(about.limits.bytes / (1 << 20))} MiB, which is the server's limit.`));
    return;
  }
  openScene({ body: file, headers: { "Content-Type": "model/gltf-binary" } }, file.name);
}

async function download(kind) {
  try {
    const response = await fetch(`scenes/${scene.scene}/picture.${kind}`);
    if (!response.ok) throw await refusalOf(response);
    const link = document.createElement("a");
    link.href = URL.createObjectURL(await response.blob());
    link.download = `${document.title.split(" – ")[0].replace(/\.[^.]*$/, "")}.${kind}`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  } catch (error) {
    complain(error);
  }
}

// Hands.

function listenToMouse() {
  let held = null;
  picture.addEventListener("pointerdown", (event) => {
    held = { x: event.clientX, y: event.clientY, moves: event.button === 2 || event.shiftKey };
    picture.setPointerCapture(event.pointerId);
    picture.classList.add("held");
  });
  picture.addEventListener("pointermove", (event) => {
    if (!held || !orbit) return;
    const [x, y] = [(event.clientX - held.x) / stage.clientHeight, (event.clientY - held.y) / stage.clientHeight];
    held = { ...held, x: event.clientX, y: event.clientY };
    if (held.moves) orbit.move(x, y);
    else orbit.turn(x * Math.PI, y * Math.PI);
    move();
  });
  for (const end of ["pointerup", "pointercancel"])
    picture.addEventListener(end, () => {
      held = null;
      picture.classList.remove("held");
    });
  picture.addEventListener("contextmenu", (event) => event.preventDefault());
  stage.addEventListener(
    "wheel",
    (event) => {
      if (!orbit) return;
      event.preventDefault();
      orbit.approach(Math.exp(0.001 * event.deltaY * (event.deltaMode === 1 ? 33 : 1)));
      move();
    },
    { passive: false },
  );
}

const KEYS = {
  ArrowLeft: () => orbit.turn(-0.1, 0),
  ArrowRight: () => orbit.turn(0.1, 0),
  ArrowUp: () => orbit.turn(0, 0.1),
  ArrowDown: () => orbit.turn(0, -0.1),
  "+": () => orbit.approach(0.9),
  "=": () => orbit.approach(0.9),
  "-": () => orbit.approach(1 / 0.9),
  Home: () => orbit.reset(),
};

function listenToKeys() {
  picture.addEventListener("keydown", (event) => {
    const action = KEYS[event.key];
    if (!action || !orbit || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    if (event.shiftKey && event.key.startsWith("Arrow"))
      orbit.move(...{ ArrowLeft: [0.05, 0], ArrowRight: [-0.05, 0], ArrowUp: [0, 0.05], ArrowDown: [0, -0.05] }[event.key]);
    else action();
    move();
  });
}

function listenToDrops() {
  let depth = 0; // of elements that the file is over
  window.addEventListener("dragenter", (event) => {
    event.preventDefault();
    ++depth;
    get("drop").hidden = false;
  });
  window.addEventListener("dragover", (event) => event.preventDefault());
  window.addEventListener("dragleave", () => {
    depth = Math.max(0, depth - 1);
    get("drop").hidden = depth === 0;
  });
  window.addEventListener("drop", (event) => {
    event.preventDefault();
    depth = 0;
    get("drop").hidden = true;
    openFile(event.dataTransfer.files[0]);
  });
}

function listenToControls() {
  for (const id of ["open", "choose"]) get(id).addEventListener("click", () => get("file").click());
  get("file").addEventListener("change", (event) => {
    openFile(event.target.files[0]);
    event.target.value = ""; // so that the same file may be chosen again
  });
  get("example").addEventListener("click", () =>
    openScene({ body: JSON.stringify({ builtin: "cornell-glass" }), headers: { "Content-Type": "application/json" } }, "cornell-glass"),
  );
  get("exposure").addEventListener("input", (event) => {
    get("stops").value = Number(event.target.value);
    move();
  });
  for (const id of ["env", "tonemap", "spp", "denoise"]) get(id).addEventListener("change", renderInFull);
  get("reset").addEventListener("click", () => {
    orbit.reset();
    move();
  });
  for (const kind of ["png", "exr"]) get(kind).addEventListener("click", () => download(kind));
  let size = 0;
  new ResizeObserver(() => {
    clearTimeout(size);
    if (scene) size = setTimeout(renderInFull, REST_MILLISECONDS);
  }).observe(stage);
}

async function learn() {
  try {
    const response = await fetch("about");
    if (!response.ok) throw await refusalOf(response);
    about = await response.json();
    get("denoising").hidden = !about.denoise;
  } catch (error) {
    complain(error);
  }
}

listenToMouse();
listenToKeys();
listenToDrops();
listenToControls();
learn();
