// A camera that circles a point: where it stands, as the server's keywords have it.

const STEEPEST = Math.PI / 2 - 0.01; // radians above or below the ground, short of the pole, where up is not defined

const add = (a, b) => a.map((x, i) => x + b[i]);
const scale = (a, s) => a.map((x) => x * s);
const subtract = (a, b) => add(a, scale(b, -1));
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const normalize = (a) => scale(a, 1 / (Math.hypot(...a) || 1));

export class Orbit {
  /** For a scene as the server describes it: through its first camera, or from the front, the right and somewhat above. */
  constructor(scene) {
    const [low, high] = scene.bounds;
    this.center = scale(add(low, high), 0.5);
    this.radius = Math.max(1e-6, 0.5 * Math.hypot(...subtract(high, low)));
    this.camera = scene.cameras[0];
    this.reset();
  }

  reset() {
    if (this.camera) {
      this.#lookThrough(this.camera);
      return;
    }
    this.fov = 35;
    this.target = this.center;
    this.azimuth = 0.6;
    this.elevation = 0.3;
    this.distance = (1.05 * this.radius) / Math.sin((this.fov * Math.PI) / 360);
  }

  #lookThrough(camera) {
    const forward = normalize(camera.forward);
    const ahead = dot(subtract(this.center, camera.look_from), forward);
    this.fov = camera.fov;
    this.distance = ahead > 0 ? ahead : this.radius;
    this.target = add(camera.look_from, scale(forward, this.distance));
    this.azimuth = Math.atan2(-forward[0], -forward[2]);
    this.elevation = Math.max(-STEEPEST, Math.min(STEEPEST, Math.asin(-forward[1])));
  }

  #outwards() {
    const level = Math.cos(this.elevation);
    return [level * Math.sin(this.azimuth), Math.sin(this.elevation), level * Math.cos(this.azimuth)];
  }

  /** By angles in radians. */
  turn(around, over) {
    this.azimuth -= around;
    this.elevation = Math.max(-STEEPEST, Math.min(STEEPEST, this.elevation + over));
  }

  /** By shares of the picture's height: what is under the mouse stays there. */
  move(right, down) {
    const outwards = this.#outwards();
    const side = normalize(cross([0, 1, 0], outwards));
    const up = cross(outwards, side);
    const height = 2 * this.distance * Math.tan((this.fov * Math.PI) / 360);
    this.target = add(this.target, add(scale(side, -right * height), scale(up, down * height)));
  }

  /** Nearer by factors below 1. */
  approach(factor) {
    this.distance = Math.max(1e-3 * this.radius, Math.min(1e3 * this.radius, this.distance * factor));
  }

  /** The keywords of a picture from here. */
  get view() {
    return { look_from: add(this.target, scale(this.#outwards(), this.distance)), look_at: this.target, fov: this.fov, no_clip: true };
  }
}
