"""Optimizers: move free points of an embedding to lower the back-projection error.

An optimizer has one method, ``optimize(objective, embedding, free, neighbors)``, and needs
of the data nothing but an :class:`~workbench.optimization.objective.Objective`.
"""

from __future__ import annotations

from workbench.registry import Registry

optimizers = Registry(
    "optimizer",
    {
        "alg12": "workbench.optimization.gradient_descent:GradientDescent",
        "local": "workbench.optimization.local_search:LocalSearch",
        "global": "workbench.optimization.global_search:GlobalSearch",
    },
    needs=("optimize",),
)
register_optimizer = optimizers.register

#: What ``--optimize`` takes.
DEFAULT_OPTIMIZER = "alg12"
