"""The authoring pad: spatial keyframes on a plane, their pose, and their time."""

from __future__ import annotations

import anywidget
import traitlets

from workbench.widgets.arrays import ArrayTrait
from workbench.widgets.module import es_module, style_sheet


class AuthoringPad(anywidget.AnyWidget):
    """Author a motion by markers on a plane and a trajectory among them.

    Whatever follows the mouse is computed in the browser: poses, refitted spatial keyframes,
    in-betweens that follow a dragged marker, deformed and drawn trajectories. Python hears of
    an edit by ``edit`` when its gesture has ended, and answers by setting the traits, all in
    one message (``with pad.hold_sync(): …``), with ``answered`` as the edit's number. Until
    then the pad shows what the person did, and no other state: what comes during a gesture or
    before the answer waits. An edit that is refused is answered too, with the state as it was.

    Every edit has ``number``, growing, and ``kind``; all but undo and redo have the ``revision``
    of the scene that was shown when the gesture began, too:

    ========= ==================================================================================
    kind      other entries
    ========= ==================================================================================
    move      ``marker``, ``to`` [x, y]
    add       ``at`` [x, y], ``frame`` of the clip whose pose it has or None, ``rotations``
              (9 numbers for each joint) and ``root`` [x, y, z]
    remove    ``marker``
    turn      ``marker``, ``joint``, ``angles`` [x, y, z] in degrees, ``place``: None to change
              the marker, [x, y] for a new one there, "best" for one that the optimizer places
    deform    ``index`` of the trajectory's point, ``to`` [x, y], ``radius``
    draw      ``points`` [[x, y], …] and ``times`` in seconds, as recorded
    retime    ``times``, one for each point of the trajectory
    undo      –
    redo      –
    ========= ==================================================================================

    Attributes
    ----------
    parents : list of int
        Parent of each joint, then of each end site; -1 for the root.
    sides : list of {"left", "right", "middle"}
        Which side of the body each node is on.
    head : int
        Node at the far end of the head's bone, -1 for none.
    offsets : array of shape (n_nodes, 3), float64
        Each node relative to its parent, in file units.
    joint_names : list of str
        One for each joint, without end sites.
    frame_time : float
        Seconds between frames.
    kernel : str
        Of the spatial keyframes.
    epsilon : float
        Its inverse width; 0 for the one that :class:`~workbench.backprojection.rbf.RBF`
        takes by itself.
    markers : array of shape (n_markers, 2), float64
        Places of the key poses.
    marker_poses : array of shape (n_markers, 9 n_joints), float64
        Rotation matrices.
    marker_roots : array of shape (n_markers, 3), float64
        Root translations.
    marker_frames : array of shape (n_markers,), int32
        The clip's frame whose pose it is; -1 for a new pose.
    marker_names : list of str
        Names of the markers.
    influence : array of shape (n_frames, n_markers), float64
        ``influence @ markers`` places the clip's frames; empty if they do not follow.
    embedding : array of shape (n_frames, 2), float64
        Places of the clip's frames.
    points : array of shape (n_points, 2), float64
        The trajectory.
    times : array of shape (n_points,), float64
        Its seconds, growing.
    follows : bool
        Whether the trajectory is the embedding, so that it follows the markers.
    ghost : array of shape (n_frames, n_nodes, 3), float32
        World positions of the original motion; empty for none.
    roots : array of shape (n_output_frames, 3), float64
        Root translations to play the trajectory's frames with, for instance with feet that do
        not slide; empty to take them from the markers.
    mode : {"scrub", "markers", "deform", "draw"}
        What the mouse does in the plane.
    radius : float
        How far along the trajectory a drag is felt, in units of the plane; 0 lets the pad choose.
    selected : int
        The marker that is selected, -1 for none.
    time : float
        The trajectory's second that is shown; sent when it stays, can be set.
    loop : bool
        Whether the end is followed by the start.
    speed : float
        1/4, 1/2, 1 or 2 times as fast.
    show_ghost : bool
        Whether the original is drawn behind the pose.
    undo_label, redo_label : str
        What would be undone and redone; empty if there is nothing.
    editable : bool
        False leaves scrubbing and playing only, as in an exported page.
    edit : dict
        The last edit, from the browser.
    revision : int
        Which scene the traits show: counts up whenever markers or trajectory have changed.
    answered : int
        Number of the last edit that the traits have taken in or refused.
    message : str
        A sentence shown below the plane: why the last edit was refused. What was done upon it
        in the meantime is put back as well.
    channel : str
        Views with the same channel show the same frame of the trajectory.
    """

    _esm = es_module(
        "back_projection",
        "kinematics",
        "colours",
        "stick_figure",
        "stage",
        "orbit",
        "time_bar",
        "places",
        "authoring_fit",
        "authoring_curve",
        "authoring_scene",
        "authoring_view",
        "authoring_plane",
        "authoring_hands",
        "authoring_drags",
        "authoring_pose",
        "authoring_time_curve",
        "authoring_time",
        "authoring_tools",
        "authoring_input",
        "authoring_words",
        "authoring_clock",
        "authoring_glide",
        "authoring_post",
        "authoring",
    )
    _css = style_sheet()

    parents = traitlets.List(traitlets.Int()).tag(sync=True)
    sides = traitlets.List(traitlets.Unicode()).tag(sync=True)
    head = traitlets.Int(-1).tag(sync=True)
    offsets = ArrayTrait("<f8")
    joint_names = traitlets.List(traitlets.Unicode()).tag(sync=True)
    frame_time = traitlets.Float(1.0).tag(sync=True)
    kernel = traitlets.Unicode("linear").tag(sync=True)
    epsilon = traitlets.Float(0.0).tag(sync=True)
    markers = ArrayTrait("<f8")
    marker_poses = ArrayTrait("<f8")
    marker_roots = ArrayTrait("<f8")
    marker_frames = ArrayTrait("<i4")
    marker_names = traitlets.List(traitlets.Unicode()).tag(sync=True)
    influence = ArrayTrait("<f8")
    embedding = ArrayTrait("<f8")
    points = ArrayTrait("<f8")
    times = ArrayTrait("<f8")
    follows = traitlets.Bool(True).tag(sync=True)
    ghost = ArrayTrait("<f4")
    roots = ArrayTrait("<f8")
    mode = traitlets.Unicode("scrub").tag(sync=True)
    radius = traitlets.Float(0.0).tag(sync=True)
    selected = traitlets.Int(-1).tag(sync=True)
    time = traitlets.Float(0.0).tag(sync=True)
    loop = traitlets.Bool(True).tag(sync=True)
    speed = traitlets.Float(1.0).tag(sync=True)
    show_ghost = traitlets.Bool(True).tag(sync=True)
    undo_label = traitlets.Unicode("").tag(sync=True)
    redo_label = traitlets.Unicode("").tag(sync=True)
    editable = traitlets.Bool(True).tag(sync=True)
    edit = traitlets.Dict().tag(sync=True)
    revision = traitlets.Int(0).tag(sync=True)
    answered = traitlets.Int(0).tag(sync=True)
    message = traitlets.Unicode("").tag(sync=True)
    channel = traitlets.Unicode("").tag(sync=True)
