"""Is the file one of CommonRoad 2020a, by the package's own schema, and precise enough?"""

import importlib.resources
from pathlib import Path

from lxml import etree
from run import BadInput, Finding

MIN_DECIMALS = 9


def load_schema() -> etree.XMLSchema:
    """The XSD that commonroad-io ships; unique ids and references belong to it."""
    folder = importlib.resources.files("commonroad.scenario_definition.xml_definition_files")
    return etree.XMLSchema(etree.fromstring((folder / "XML_commonRoad_XSD.xsd").read_bytes()))


def check_schema(xml: Path) -> tuple[list[Finding], str]:
    try:
        document = etree.parse(xml)
    except OSError as error:
        raise BadInput(f"{xml}: cannot be read, must be a CommonRoad file") from error
    except etree.XMLSyntaxError as error:
        return [Finding("schema", f"no XML: {error.msg}")], ""
    schema = load_schema()
    if not schema.validate(document):
        first = schema.error_log[0]
        return [Finding("schema", f"line {first.line}: {first.message}")], ""
    for number in document.iterfind(".//dynamicObstacle//*"):
        if number.tag in ("x", "y") or number.tag == "exact" and number.getparent().tag != "time":
            if len(number.text.partition(".")[2]) < MIN_DECIMALS:
                text = f"line {number.sourceline}: {number.text}, must have >= {MIN_DECIMALS} decimals"
                return [Finding("decimals", text)], ""
    elements = document.xpath("count(/commonRoad/*[@id])")
    return [], f"valid, {elements:.0f} elements with ids of their own"
