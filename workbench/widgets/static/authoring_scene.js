// What the pad shows: the traits as they came, changed by what the hand does until Python
// answers. It computes, and knows of no page.

class AuthoredScene {
  constructor(model) {
    const numbers = (name, Type = Float64Array) => typed(model.get(name), Type);
    this.kernel = model.get("kernel");
    this.epsilon = model.get("epsilon");
    this.frameTime = model.get("frame_time");
    this.markers = numbers("markers");
    this.poses = numbers("marker_poses");
    this.markerRoots = numbers("marker_roots");
    this.markerFrames = [...numbers("marker_frames", Int32Array)];
    this.names = [...model.get("marker_names")];
    this.influence = numbers("influence");
    this.embedding = numbers("embedding");
    this.points = numbers("points");
    this.times = numbers("times");
    this.follows = model.get("follows");
    this.ghost = numbers("ghost", Float32Array);
    this.roots = numbers("roots");
    this.body = { parents: model.get("parents"), offsets: numbers("offsets"), joints: model.get("joint_names").length };
    this.fitted = undefined; // null where the markers have no function through them
    this.problem = "";
    this.kinematics = new Kinematics(this.body);
  }

  get count() {
    return this.markers.length / 2;
  }

  get nodes() {
    return this.body.parents.length;
  }

  /** Whether the arrays fit each other: traits may come one after the other. */
  get fits() {
    const { count, body, nodes, times, embedding, influence, ghost } = this;
    return (
      nodes > 0 && count > 0 && body.offsets.length === 3 * nodes &&
      this.poses.length === 9 * body.joints * count && this.markerRoots.length === 3 * count &&
      this.markerFrames.length === count && this.points.length === 2 * times.length && times.length > 1 &&
      (!influence.length || influence.length * 2 === embedding.length * count) &&
      (!this.follows || embedding.length === this.points.length) && ghost.length % (3 * nodes) === 0
    );
  }

  marker(j) {
    return [this.markers[2 * j], this.markers[2 * j + 1]];
  }

  nameOf(j) {
    const frame = this.markerFrames[j];
    return this.names[j] || (frame < 0 ? "new pose" : `frame ${frame}`);
  }

  // What the hand changes, until Python answers.

  /** Say where frames are beside where markers put them, before a marker is moved. */
  shifts() {
    if (!this.influence.length) return null;
    const placed = placedFrames(this.influence, this.markers);
    return this.embedding.map((v, i) => v - placed[i]);
  }

  /** Put a marker elsewhere; frames follow, and `part` of what they were shifted by is gone. */
  moveMarker(j, [x, y], shifts, part) {
    this.markers = this.markers.slice();
    this.markers.set([x, y], 2 * j);
    this.fitted = undefined;
    if (!shifts) return;
    const placed = placedFrames(this.influence, this.markers);
    if (part < 1) for (let i = 0; i < placed.length; i++) placed[i] += (1 - part) * shifts[i];
    this.embedding = placed;
    if (this.follows) this.takePoints(placed);
  }

  /** Show other places of the trajectory's points. */
  takePoints(points) {
    this.points = points;
    this.roots = new Float64Array(0); // they were those of the trajectory before
  }

  takeTimes(times) {
    this.times = times;
    this.roots = new Float64Array(0);
  }

  /** Show another trajectory in place of the one that is there. */
  draw(points, times) {
    this.follows = false;
    this.takePoints(points);
    this.times = times;
  }

  addMarker([x, y], frame, rotations, root) {
    this.markers = Float64Array.from([...this.markers, x, y]);
    this.poses = Float64Array.from([...this.poses, ...rotations]);
    this.markerRoots = Float64Array.from([...this.markerRoots, ...root]);
    this.markerFrames.push(frame ?? -1);
    this.names.push("");
    this.influence = new Float64Array(0);
    this.fitted = undefined;
  }

  removeMarker(j) {
    const without = (array, width) => array.filter((_, i) => Math.floor(i / width) !== j);
    this.markers = without(this.markers, 2);
    this.poses = without(this.poses, 9 * this.body.joints);
    this.markerRoots = without(this.markerRoots, 3);
    this.markerFrames.splice(j, 1);
    this.names.splice(j, 1);
    this.influence = new Float64Array(0);
    this.fitted = undefined;
  }

  /** The pose of a marker with a joint turned by degrees about its own x, then y, then z. */
  turned(j, joint, angles) {
    const width = 9 * this.body.joints;
    const pose = this.poses.slice(j * width, (j + 1) * width);
    let matrix = pose.slice(9 * joint, 9 * joint + 9);
    angles.forEach((degrees, axis) => (matrix = product3(matrix, axisTurn(axis, degrees))));
    pose.set(matrix, 9 * joint);
    return pose;
  }

  takePose(j, pose) {
    this.poses = this.poses.slice();
    this.poses.set(pose, j * pose.length);
    this.fitted = undefined;
  }

  // Poses.

  /** Fit the spatial keyframes, if markers have changed since. */
  fit() {
    if (this.fitted !== undefined) return;
    const width = 9 * this.body.joints;
    const values = new Float64Array(this.count * (width + 3));
    for (let j = 0; j < this.count; j++) {
      values.set(this.poses.subarray(j * width, (j + 1) * width), j * (width + 3));
      values.set(this.markerRoots.subarray(3 * j, 3 * j + 3), j * (width + 3) + width);
    }
    this.problem = "";
    try {
      this.fitted = new FittedRadial({ kernel: this.kernel, epsilon: this.epsilon, points: this.markers, values });
      this.lastGood = this.fitted;
      if (this.fitted.merged.length) {
        const names = this.fitted.merged[0].map((j) => this.nameOf(j)).join(" and ");
        this.problem = `${names} are at the same place, where their mean pose is shown. Move one of them.`;
      }
    } catch (error) {
      this.fitted = this.lastGood ?? null;
      this.problem = `No pose can be computed: ${error.message}. The last one is kept.`;
    }
  }

  /** Joint rotations at a place of the plane, and where the root is; null if there are none. */
  poseAt(place) {
    this.fit();
    if (!this.fitted) return null;
    const values = this.fitted.at(place);
    const width = 9 * this.body.joints;
    return { rotations: nearestRotations(values.subarray(0, width)), root: values.subarray(width) };
  }

  /** Positions of the nodes of a pose, overwritten by the next call. */
  positions({ rotations, root }) {
    return this.kinematics.place(rotations, root);
  }

  // Time.

  get start() {
    return this.times[0];
  }

  get duration() {
    return this.times.at(-1) - this.times[0];
  }

  get frames() {
    return frameCount(this.times, this.frameTime);
  }

  get clipFrames() {
    return this.embedding.length / 2;
  }

  frameAt(time) {
    return Math.max(0, Math.min(this.frames - 1, Math.floor((time - this.start) / this.frameTime + 1e-6)));
  }

  placeAt(time) {
    return placeAt(this.points, this.times, time);
  }

  /** The root at a time as Python wants it, if it has sent any: between frames, as the pose is. */
  rootAt(time) {
    if (!this.roots.length || this.roots.length !== 3 * this.frames) return null;
    const exact = Math.max(0, Math.min(this.frames - 1, (time - this.start) / this.frameTime));
    const frame = Math.floor(exact);
    const [here, next] = [3 * frame, 3 * Math.min(frame + 1, this.frames - 1)];
    return [0, 1, 2].map((k) => this.roots[here + k] + (exact - frame) * (this.roots[next + k] - this.roots[here + k]));
  }

  /** Positions of the original motion at a time; null after its end. */
  ghostAt(time) {
    const frame = Math.floor((time - this.start) / this.frameTime + 1e-6);
    const width = 3 * this.nodes;
    return frame >= 0 && (frame + 1) * width <= this.ghost.length ? this.ghost.subarray(frame * width, (frame + 1) * width) : null;
  }
}

/** A rotation about x (0), y (1) or z (2). */
function axisTurn(axis, degrees) {
  const [c, s] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
  return [[1, 0, 0, 0, c, -s, 0, s, c], [c, 0, s, 0, 1, 0, -s, 0, c], [c, -s, 0, s, c, 0, 0, 0, 1]][axis];
}

function product3(a, b) {
  return Float64Array.from({ length: 9 }, (_, at) => {
    const [i, j] = [3 * Math.floor(at / 3), at % 3];
    return a[i] * b[j] + a[i + 1] * b[3 + j] + a[i + 2] * b[6 + j];
  });
}
