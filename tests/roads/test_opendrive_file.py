"""What is no file, no XML or no OpenDRIVE is told as that; an attack by XML gets nothing."""

from __future__ import annotations

from pathlib import Path

import pytest

from .conftest import OURS, broken


@pytest.mark.parametrize("text", ["", "not xml at all", OURS[: len(OURS) // 2], OURS.replace("</planView>", "", 1)])
def test_what_is_not_xml(tmp_path: Path, text: str) -> None:
    assert "not well-formed XML" in broken(tmp_path, text).message


def test_what_is_xml_but_not_opendrive(tmp_path: Path) -> None:
    assert broken(tmp_path, "<commonRoad/>").found == "root element <commonRoad>"


def test_entities_are_not_expanded(tmp_path: Path) -> None:
    secret = tmp_path / "secret"
    secret.write_text("secret words")
    head = f'<?xml version="1.0"?><!DOCTYPE OpenDRIVE [<!ENTITY x SYSTEM "{secret.as_uri()}">]>'
    assert "secret words" not in str(broken(tmp_path, f"{head}<OpenDRIVE><road>&x;</road></OpenDRIVE>"))
