// Forward kinematics: from joint rotations to positions, as mocap/kinematics.py does it.
// Nothing here knows of a page: authoring uses it too.

/**
 * A tree of nodes: the joints, each after its parent, then the end sites, which have no
 * rotation. `offsets` has three numbers for each node, relative to its parent.
 */
class Kinematics {
  constructor({ parents, offsets, joints }) {
    this.parents = parents;
    this.offsets = offsets;
    this.joints = joints;
    this.world = new Float64Array(9 * joints);
    this.positions = new Float64Array(3 * parents.length);
  }

  /** Place all nodes; the positions are overwritten by the next call. */
  place(rotations, root) {
    const { parents, offsets, joints, world, positions } = this;
    for (let node = 0; node < parents.length; node++) {
      const parent = parents[node];
      const own = 9 * node;
      if (parent < 0) {
        positions.set(root, 3 * node);
        for (let i = 0; i < 9; i++) world[own + i] = rotations[own + i];
        continue;
      }
      const x = offsets[3 * node], y = offsets[3 * node + 1], z = offsets[3 * node + 2];
      for (let i = 0; i < 3; i++) {
        const row = 9 * parent + 3 * i;
        const a = world[row], b = world[row + 1], c = world[row + 2];
        positions[3 * node + i] = positions[3 * parent + i] + a * x + b * y + c * z;
        if (node >= joints) continue;
        for (let j = 0; j < 3; j++) {
          world[own + 3 * i + j] = a * rotations[own + j] + b * rotations[own + 3 + j] + c * rotations[own + 6 + j];
        }
      }
    }
    return positions;
  }
}
