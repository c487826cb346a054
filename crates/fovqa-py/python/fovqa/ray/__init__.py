"""Runs of experiments on Ray: on the cores of one machine, or on a cluster.

The frames of an experiment are divided into units. Each worker finds the frames once and scores one unit after
another; a unit whose worker dies is scored by another one. The results are those of :func:`fovqa.run`, to the byte.

Needs Ray: ``pip install 'fovqa[ray]'``. docs/cluster.md describes clusters, and what happens when a node dies.
"""

from __future__ import annotations

from ._driver import ClusterRun, UnitsError, run

__all__ = ["ClusterRun", "UnitsError", "run"]
