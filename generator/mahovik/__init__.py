"""Exact equations of motion of a carrier with unbalanced, asymmetric flywheels, as verified C.

    import mahovik

    stand = mahovik.load("bench8.toml")
    model = mahovik.build(stand)
    result = model.forward(model.state(phi_dot=100.0), phi_ddot={"w1": 5.0})
    result.V_dot

Public is what `__all__` names; docs/python.md describes it. Each name is loaded when it is first asked for;
its type stands in `__init__.pyi`.
"""

__version__ = "0.1.0"

__all__ = [
    "InputError",
    "MahovikError",
    "MahovikWarning",
    "Model",
    "Progress",
    "RefusedError",
    "Result",
    "Stand",
    "StandError",
    "StateError",
    "States",
    "Status",
    "ToolchainError",
    "UsageError",
    "__version__",
    "balance",
    "build",
    "campaign",
    "check",
    "eval",
    "evidence",
    "example",
    "examples",
    "generate",
    "identify",
    "judge",
    "load",
    "modes",
    "new",
    "plan",
    "replay",
    "report",
    "simulate",
    "status_words",
    "verify",
    "vibration",
]

_PLACES = {
    "MahovikWarning": "out.notices",
    "Model": "out.api.model",
    "Progress": "out.notices",
    "Result": "out.result",
    "Stand": "out.api.stands",
    "States": "out.api.states",
    "Status": "out.api.calls",
    "balance": "out.commands.balance",
    "build": "out.api.model",
    "campaign": "out.commands.campaign",
    "check": "out.commands.check",
    "eval": "out.commands.eval",
    "evidence": "out.commands.evidence",
    "example": "out.api.stands",
    "examples": "out.api.stands",
    "generate": "out.commands.generate",
    "identify": "out.commands.identify",
    "judge": "out.commands.judge",
    "load": "out.api.stands",
    "modes": "out.commands.modes",
    "new": "out.commands.new",
    "plan": "out.commands.plan",
    "replay": "out.commands.replay",
    "report": "out.commands.report",
    "simulate": "out.commands.simulate",
    "status_words": "out.api.calls",
    "verify": "out.commands.verify",
    "vibration": "out.commands.vibration",
}


def __getattr__(name: str) -> object:
    if name not in __all__:
        raise AttributeError(f"module 'mahovik' has no attribute {name!r}")
    from importlib import import_module

    result = getattr(import_module(f"mahovik.{_PLACES.get(name, 'errors')}"), name)
    globals()[name] = result  # the next time without this
    return result


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
