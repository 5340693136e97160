"""Undo and redo without limit: scenes are never changed, so a list of them is the history."""

from __future__ import annotations

from workbench.authoring.scene import Scene


class History:
    """The scenes that an author made, one after the other, and which of them is shown.

    Parameters
    ----------
    scene : Scene
        The first one.

    Examples
    --------
    >>> from workbench import load_space
    >>> from workbench.authoring import edits, scene_on_circle
    >>> first = scene_on_circle(load_space("cmu/01_01-jump"), selector="uniform", count=4)
    >>> history = History(first)
    >>> history.do("keep the feet", edits.set_keep_feet(first, True)).keep_feet
    True
    >>> history.undo_label, history.undo() is first, history.redo_label
    ('keep the feet', True, 'keep the feet')
    """

    def __init__(self, scene: Scene) -> None:
        self._scenes = [scene]
        self._labels: list[str] = []
        self._place = 0

    def __len__(self) -> int:
        """Count the scenes, those that can be redone included."""
        return len(self._scenes)

    @property
    def scene(self) -> Scene:
        """The scene that is shown."""
        return self._scenes[self._place]

    @property
    def undo_label(self) -> str:
        """What :meth:`undo` takes back, empty if there is nothing."""
        return self._labels[self._place - 1] if self._place else ""

    @property
    def redo_label(self) -> str:
        """What :meth:`redo` makes again, empty if there is nothing."""
        return self._labels[self._place] if self._place < len(self._labels) else ""

    def do(self, label: str, scene: Scene) -> Scene:
        """Go on with another scene; what was undone before cannot be redone any more.

        Parameters
        ----------
        label : str
            What was done, for menus.
        scene : Scene
            What came of it.

        Returns
        -------
        Scene
            That scene.
        """
        del self._scenes[self._place + 1 :], self._labels[self._place :]
        self._scenes.append(scene)
        self._labels.append(label)
        self._place += 1
        return scene

    def amend(self, scene: Scene) -> Scene:
        """Replace the scene that is shown, without a step of its own.

        What is computed beside an edit and comes later belongs to it: both are undone at once.

        Parameters
        ----------
        scene : Scene
            In place of the one that is shown.

        Returns
        -------
        Scene
            That scene.
        """
        self._scenes[self._place] = scene
        return scene

    def undo(self) -> Scene:
        """Go back by one edit, if there is one; gives the scene that is shown then."""
        self._place = max(0, self._place - 1)
        return self.scene

    def redo(self) -> Scene:
        """Make what was undone again, if there is something; gives the scene shown then."""
        self._place = min(len(self._labels), self._place + 1)
        return self.scene
