"""An OpenDRIVE file as XML: what is no file, no XML, no OpenDRIVE or out of all proportion is refused here.

What enters: a path. What leaves: the root element. What the elements say is read by `opendrive_xml`.
"""

from __future__ import annotations

from pathlib import Path

from lxml import etree

from scenewright.errors import MapError, Place

Element = etree._Element

_LARGEST_FILE = 200_000_000  # bytes; town maps have one to twenty million


def parse_opendrive(source: Path) -> Element:
    """Return the root element of an OpenDRIVE file, its tags without namespaces.

    Raises
    ------
    MapError
        If the file is missing, too large, not XML or not OpenDRIVE.
    """
    place = Place(source.name)
    parser = etree.XMLParser(resolve_entities=False, no_network=True, remove_comments=True, remove_pis=True)
    try:
        with source.open("rb") as file:
            text = file.read(_LARGEST_FILE + 1)
    except OSError as fault:
        raise MapError(
            "the map file cannot be read",
            place=Place(str(source)),
            found=fault.strerror or str(fault),
            expected="a readable OpenDRIVE file",
            fix="check the path; `scenewright maps` lists the maps that come with Scenewright",
        ) from fault
    if len(text) > _LARGEST_FILE:
        raise MapError(
            "the map file is too large",
            place=place,
            found=f"more than {_LARGEST_FILE:,} bytes",
            expected=f"at most {_LARGEST_FILE:,} bytes",
            fix="cut out the part of the map that the scenario is about",
        )
    try:
        root = etree.fromstring(text, parser)
    except etree.XMLSyntaxError as fault:
        raise MapError(
            "the map file is not well-formed XML",
            place=Place(source.name, line=fault.lineno or None),
            found=(fault.msg or "an empty file").split(" (")[0],
            expected="an OpenDRIVE file: XML with the root element <OpenDRIVE>",
            fix="export the map again, or give a file that ends in .xodr",
        ) from fault
    name = etree.QName(root).localname
    if name != "OpenDRIVE":
        raise MapError(
            "the map file is XML, but not OpenDRIVE",
            place=Place(place.name, line=root.sourceline),
            found=f"root element <{name}>",
            expected="root element <OpenDRIVE>",
            fix="convert the map to OpenDRIVE (.xodr) first",
        )
    for element in root.iter():
        if isinstance(element.tag, str):  # files of version 1.8 may carry a namespace; the names stay the same
            element.tag = etree.QName(element).localname
    return root
