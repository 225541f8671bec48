"""The verdict of a verification on targets as JSON and as JUnit XML."""

from __future__ import annotations

import json
import xml.etree.ElementTree as ET
from dataclasses import asdict

from mahovik.proof.verify.targets import TargetsReport


def as_json(report: TargetsReport) -> str:
    """The table for programs."""
    found = {
        "stand": report.stand,
        "structure": report.structure,
        "physics": report.physics,
        "states": report.sweep,
        "passed": report.passed,
        "conclusion": report.conclusion,
        "rows": [asdict(row) for row in report.rows],
    }
    return json.dumps(found, indent=1)


def as_junit(report: TargetsReport) -> str:
    """The table for continuous integration: a test case for each target and element type."""
    suite = ET.Element("testsuite", name=f"mahovik verify {report.stand} --targets")
    for row in report.rows:
        name = f"{row.target} {row.real}: {row.built_with}"
        case = ET.SubElement(suite, "testcase", classname=f"mahovik.{report.stand}", name=name)
        if row.failed:
            ET.SubElement(case, "failure", message=row.reason)
        elif row.missing:
            ET.SubElement(case, "error", message=row.reason)
        elif row.verdict != "ok":
            ET.SubElement(case, "skipped", message=row.reason)
    counts = {
        "tests": len(report.rows),
        "failures": sum(row.failed for row in report.rows),
        "errors": sum(row.missing for row in report.rows),
        "skipped": sum(row.verdict == "not here" for row in report.rows),
    }
    for key, number in counts.items():
        suite.set(key, str(number))
    ET.indent(suite)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ET.tostring(suite, encoding="unicode") + "\n"
