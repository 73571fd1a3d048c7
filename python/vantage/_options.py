# SPDX-License-Identifier: MIT
"""Keywords of the method on functions: names, signatures and docstrings from the one table."""

from __future__ import annotations

import functools
import inspect
import textwrap
from typing import Any, Callable, List, Mapping

from . import _core

TABLE: List[Mapping[str, Any]] = _core.options()


def _in_groups(groups: "tuple[str, ...]", but: "tuple[str, ...]") -> List[Mapping[str, Any]]:
    return [row for row in TABLE if row["group"] in groups and row["name"] not in but]


def _line(row: Mapping[str, Any]) -> str:
    """One option as the docstring says it."""
    default = repr(row["default"])
    if row["paper"] != row["default"]:
        default += f"; {row['paper']!r} with preset=\"paper\""
    reach = "" if row["low"] is None else f" in [{row['low']:g}, {row['high']:g}]"
    text = f"{row['name']}: {row['type']}{reach}. {row['help']}. Default: {default}."
    return textwrap.fill(text, 96, initial_indent="    ", subsequent_indent="        ")


def takes(*groups: str, but: "tuple[str, ...]" = ()) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Gives a function the keywords of these groups in place of its **options, `but` for these."""
    rows = _in_groups(groups, but)
    names = {row["name"] for row in rows}

    def give(function: Callable[..., Any]) -> Callable[..., Any]:
        own = [p for p in inspect.signature(function).parameters.values()
               if p.kind is not inspect.Parameter.VAR_KEYWORD]
        known = {p.name for p in own}

        @functools.wraps(function)
        def checked(*arguments: Any, **keywords: Any) -> Any:
            for name in keywords:
                if name not in names and name not in known:
                    raise TypeError(f"{function.__name__}() got an unexpected keyword argument "
                                    f"{name!r}")
            given = {name: value for name, value in keywords.items()
                     if value is not None or name == "model"}
            return function(*arguments, **given)

        keywords = [inspect.Parameter(row["name"], inspect.Parameter.KEYWORD_ONLY, default=None)
                    for row in rows]
        checked.__signature__ = inspect.Signature([*own, *keywords])  # type: ignore[attr-defined]
        checked.__doc__ = ((function.__doc__ or "").rstrip() + "\n\n    Options, as those of the "
                           "program; None stands for the default:\n\n" +
                           "\n".join(map(_line, rows)) + "\n    ")
        return checked

    return give
