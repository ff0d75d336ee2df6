"""The archive itself: complete, readable everywhere, laid out as FMI says."""

from __future__ import annotations

import zipfile

import fmpy

from cardan.check.base import Check, Findings, listed
from cardan.check.subject import Subject

METHODS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
TOP_LEVEL = ("modelDescription.xml", "model.png", "documentation", "sources", "binaries", "resources", "extra",
             "terminalsAndIcons", "licenses")


class ArchiveFile(Check):
    """FMI 2.0 section 2.3: FMU distribution."""

    id = "archive"
    title = "Archive: readable, complete, laid out as FMI says"
    proves = "every member can be read and has the right checksum; names and compression are portable"

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Read every member."""
        with zipfile.ZipFile(subject.path) as archive:
            members = archive.infolist()
            damaged = archive.testzip()
            if damaged is not None:
                found.fail(f"{damaged} is damaged: its checksum is wrong")
            names = [member.filename for member in members]
            self._names(names, found)
            odd = [member.filename for member in members if member.compress_type not in METHODS]
            if odd:
                found.fail(f"compressed by another method than deflate, which importers need not know: {listed(odd)}")
        platforms = sorted({name.split("/")[1] for name in names if name.startswith("binaries/") and name[-1] != "/"})
        found.remark(f"binaries for {', '.join(platforms)}; {len(names)} members, {subject.path.stat().st_size} bytes")
        if not subject.native:
            found.remark(f"runs in the Python of the importing process on {fmpy.platform} (resources/slavemodule.txt)")

    @staticmethod
    def _names(names: list[str], found: Findings) -> None:
        seen: dict[str, str] = {}
        for name in names:
            other = seen.setdefault(name.lower(), name)
            if other is not name:
                found.fail(f"two members have the same name where case does not count: {other} and {name}")
        strange = [name for name in names if not name.isascii()]
        if strange:
            found.warn(f"member names beyond ASCII, which not every importer can unpack: {listed(strange)}")
        unknown = sorted({name.split("/")[0] for name in names} - set(TOP_LEVEL))
        if unknown:
            found.remark(f"on the top level besides what FMI names: {listed(unknown)}")
