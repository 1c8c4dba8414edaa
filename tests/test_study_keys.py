"""Files of studies and of comparisons are read by one rule."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from pyfret.study import compare_file, file


@pytest.mark.parametrize(
    ("run", "table"),
    [(file.run_study_file, "parameters"), (compare_file.run_compare_file, "candidates")],
)
@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("scene = ]\n", "line 1"),
        ("scene = 5\n[{table}]\n", "`scene` = 5: must be the name of a file in quotes"),
        ("out = 1.5\nscene = 's.toml'\n[{table}]\n", "`out` = 1.5: must be the name of a file"),
        ("[{table}]\n", "the key `scene` is missing"),
        ("scene = 's.toml'\n", "the key `{table}` is missing"),
        ("scenes = 's.toml'\n", "unknown key `scenes`: the nearest valid key is `scene`"),
    ],
)
def test_what_a_file_may_say(
    run: Callable[[Path], Any], table: str, text: str, expected: str, tmp_path: Path
) -> None:
    path = tmp_path / "file.toml"
    path.write_text(text.format(table=table))
    with pytest.raises(ValueError) as refused:  # noqa: PT011
        run(path)
    assert expected.format(table=table) in str(refused.value)
    assert str(path) in str(refused.value)
