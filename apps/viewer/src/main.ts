// SPDX-License-Identifier: MIT
// The page: document in, stage up, one redraw per change.
import * as THREE from "three";
import { AgeSlider, ageText, ageTone, shortAge } from "./age_slider";
import { Bake, type MapName } from "./bake";
import { ButtonRow } from "./buttons";
import { PageFault, readDocument, type ViewerDocument } from "./data";
import { FlatView, mapsOf, type MapView } from "./flat";
import { FlatGestures } from "./flat_gestures";
import { listen } from "./keyboard";
import { Legend } from "./legend";
import { fillHelp, fillPanel } from "./panel";
import { Stage } from "./scene";
import { type Shape, kShapes } from "./shapes";
import { Specimen } from "./specimen";
import { makeOverlay } from "./uncertainty";
import { Wipe } from "./wipe";

interface TestApi {
  ready: Promise<void>;
  setAge(age: number): void;
  readMap(name: MapName): ReturnType<Bake["read"]>;
  readonly age: number;
  info?: ViewerDocument;
}
declare global { interface Window { verdigris: TestApi } }

const element = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

function fault(message: string): void {
  const box = element("fault");
  box.textContent = message;
  box.hidden = false;
}

function makeRenderer(): THREE.WebGLRenderer {
  const canvas = element<HTMLCanvasElement>("view");
  const context = canvas.getContext("webgl2", { antialias: true, alpha: true });
  if (!context) {
    throw new PageFault("This browser or device offers no WebGL 2, which the picture needs. " +
      "The contact sheet and the textures beside this page need none.");
  }
  canvas.addEventListener("webglcontextlost", () =>
    fault("The graphics device was reset and the picture is lost. Reload the page to go on."));
  return new THREE.WebGLRenderer({ canvas, context, antialias: true, alpha: true });
}

async function start(api: TestApi): Promise<void> {
  const doc = readDocument();
  api.info = doc;
  document.title = `${doc.title} \u2013 Verdigris`;
  element("title").textContent = doc.title;
  element("subtitle").textContent =
    `observed for ${doc.units_observed.toFixed(0)} units, forecast to +${doc.horizons.at(-1) ?? 0}`;
  fillPanel(doc);
  fillHelp(doc);
  const renderer = makeRenderer();
  const specimen = await Specimen.load(doc, renderer.capabilities.maxTextureSize);
  const aspect = doc.width / doc.height;
  const current = new Bake(renderer, specimen);
  const reference = new Bake(renderer, specimen);
  reference.bake(0);

  let view: MapView = "lit", pending = 0;
  const stageBox = element("stage");
  const redraw = () => { if (!pending) pending = requestAnimationFrame(draw); };
  const overlay = makeOverlay(), legend = new Legend(doc);
  const over = () => overlay.u_over.value > 0;
  const stage = new Stage(renderer, aspect, overlay, redraw);
  const flat = new FlatView(renderer, aspect, doc.width, overlay);
  const gestures = new FlatGestures(renderer.domElement, flat, redraw);
  const wipe = new Wipe(stageBox, redraw);
  const one = (bake: Bake, width: number, height: number) => {
    if (over() || view === "uncertainty") bake.bakeUncertainty();
    if (view === "lit") stage.draw(bake, legend.below);
    else flat.draw(bake, view, width, height, legend.below);
  };

  function draw(): void {
    pending = 0;
    current.bake(slider.age);
    const width = stageBox.clientWidth, height = stageBox.clientHeight;
    if (width === 0 || height === 0) return;
    if (!wipe.on) { one(current, width, height); return; }
    const border = Math.round(width * wipe.at);
    renderer.setScissorTest(true);
    renderer.setScissor(0, 0, border, height);
    one(reference, width, height);
    renderer.setScissor(border, 0, width - border, height);
    one(current, width, height);
    renderer.setScissorTest(false);
  }

  const first = Math.min(specimen.firstUnit, 0);
  const held = doc.trajectory.kind === "law" && doc.trajectory.order === 0;
  const range = { first, last: specimen.lastUnit, trust: 2 * doc.context, held };
  let spoken = 0;
  const say = (text: () => string, after: number) => {
    window.clearTimeout(spoken);
    spoken = window.setTimeout(() => { element("live").textContent = text(); }, after);
  };
  const slider = new AgeSlider(doc, range, (age) => {
    const badge = element("badge"), tone = ageTone(age, range);
    badge.textContent = age < 0.05 ? "observed" : held ? "forecast, held" : "forecast";
    badge.className = tone;
    wipe.label(shortAge(age, held), tone);
    legend.show(view, over(), age);
    say(() => ageText(age, held), 600);
    redraw();
  });

  const known = mapsOf(doc);
  const maps = new ButtonRow("maps", known, (_, i) => String(i + 1), pickMap);
  const shapes = new ButtonRow<Shape>("shapes", kShapes, (n) => n[0]!.toUpperCase(), pickShape);
  function pickMap(name: MapView): void {
    view = name;
    maps.press(name);
    stage.controls.enabled = name === "lit";
    gestures.on = name !== "lit";
    legend.show(view, over(), slider.age);
    say(() => `${name} map`, 300);
    redraw();
  }
  function pickShape(name: Shape): void {
    stage.setShape(name);
    shapes.press(name);
    pickMap("lit");
  }
  const overButton = element("over-toggle");
  overButton.hidden = !doc.spread;
  function toggleOverlay(): void {
    if (!doc.spread) return;
    overlay.u_over.value = over() ? 0 : 1;
    overButton.setAttribute("aria-pressed", String(over()));
    // It is painted over the material and its albedo; on any other map the key would do nothing.
    if (over() && view !== "albedo") pickMap("lit");
    legend.show(view, over(), slider.age);
    say(() => (over() ? "uncertainty over the material" : "material without the uncertainty"), 300);
    redraw();
  }
  overButton.addEventListener("click", toggleOverlay);
  const light = element<HTMLInputElement>("light");
  const turnLight = (to: number) => {
    light.value = String(to);
    light.setAttribute("aria-valuetext", `${light.value} degrees`);
    stage.studio.turn((Number(light.value) * Math.PI) / 180);
    redraw();
  };
  light.addEventListener("input", () => turnLight(Number(light.value)));
  const panelButton = element("panel-toggle");
  const showPanel = (on: boolean) => {
    document.body.classList.toggle("panel-closed", !on);
    panelButton.setAttribute("aria-expanded", String(on));
  };
  panelButton.addEventListener("click", () => showPanel(document.body.classList.contains("panel-closed")));
  showPanel(window.innerWidth > 900);
  listen({ slider, wipe, stage, gestures, maps: known, pickMap, pickShape, toggleOverlay,
    turnLight: (degrees) => turnLight(((Number(light.value) + degrees + 540) % 360) - 180) });

  new ResizeObserver(() => {
    const width = stageBox.clientWidth, height = stageBox.clientHeight;
    if (width === 0 || height === 0) return;
    renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    renderer.setSize(width, height, false);
    stage.resize(width, height);
    redraw();
  }).observe(stageBox);

  api.setAge = (age) => { slider.set(age); current.bake(age); };
  api.readMap = (name) => current.read(name);
  Object.defineProperty(api, "age", { get: () => slider.age });
  slider.set(0);
  await new Promise((done) => requestAnimationFrame(done));
}

const api = { age: 0, setAge: () => undefined, ready: Promise.resolve() } as unknown as TestApi;
window.verdigris = api;
api.ready = start(api);
api.ready.catch((error: unknown) => fault(error instanceof PageFault ? error.message
  : `This page cannot be shown: its data are damaged or were cut short (${String(error)}).`));
