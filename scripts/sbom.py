#!/usr/bin/env python3
"""Writes what Debian packages consist of, as SPDX 2.3 (a bill of materials).

  scripts/sbom.py FOLDER        out/debian, where scripts/debian.sh has built

FOLDER has the .deb files and the .buildinfo of one build. The document lists
each package with its checksum, what it depends on, and everything that was
installed where it was built, in the versions that were there. Prints the name
of the file, FOLDER/halfspace_VERSION.spdx.json; the same build gives the same
bytes.
"""

import datetime
import hashlib
import json
import pathlib
import re
import subprocess
import sys


def fields_of(text):
    """Fields of one paragraph in Debian's form, continued lines joined."""
    fields, name = {}, None
    for line in text.splitlines():
        if line[:1] in " \t" and name:
            fields[name] += "\n" + line.strip()
        elif match := re.match(r"([A-Za-z0-9-]+):\s*(.*)", line):
            name = match[1]
            fields[name] = match[2]
    return fields


def control_of(deb):
    """The control fields of a .deb."""
    return fields_of(subprocess.run(["dpkg-deb", "-f", deb], text=True,
                                    check=True, capture_output=True).stdout)


def names_of(depends):
    """The packages of a Depends field; of alternatives the first."""
    entries = filter(None, map(str.strip, depends.split(",")))
    return [re.split(r"[\s(|:]", entry)[0] for entry in entries]


def licence_of(package):
    """What its copyright file says of all its files, in words of SPDX.

    Only plain names are taken; a person must read the others.
    """
    copyright_file = pathlib.Path(f"/usr/share/doc/{package}/copyright")
    try:
        text = copyright_file.read_text(errors="replace")
    except OSError:
        return "NOASSERTION"
    for paragraph in text.split("\n\n"):
        fields = fields_of(paragraph)
        if fields.get("Files", "").split("\n")[0].strip() == "*":
            name = fields.get("License", "").split("\n")[0].strip()
            known = {"Apache-2.0", "Zlib", "BSL-1.0", "MIT", "BSD-3-Clause"}
            return name if name in known else "NOASSERTION"
    return "NOASSERTION"


def identifier(name):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", name)


def package(name, version, checksum=None):
    """A package's entry."""
    entry = {
        "SPDXID": identifier(name),
        "name": name,
        "versionInfo": version,
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "licenseConcluded": "NOASSERTION",
        "licenseDeclared": "Apache-2.0" if checksum else licence_of(name),
        "copyrightText": "NOASSERTION",
        "externalRefs": [{
            "referenceCategory": "PACKAGE-MANAGER",
            "referenceType": "purl",
            "referenceLocator": f"pkg:deb/debian/{name}@{version}"}],
    }
    if checksum:
        entry["checksums"] = [{"algorithm": "SHA256",
                               "checksumValue": checksum}]
    return entry


def document(debs, buildinfo):
    """The whole document, of (control fields, checksum) and a .buildinfo."""
    version = buildinfo["Version"]
    time = datetime.datetime.strptime(
        buildinfo["Build-Date"], "%a, %d %b %Y %H:%M:%S %z")
    installed = dict(re.findall(r"(\S+) \(= ([^)]+)\)",
                                buildinfo["Installed-Build-Depends"]))
    packages, relations = {}, []

    def relate(one, kind, other):
        relations.append({"spdxElementId": one, "relationshipType": kind,
                          "relatedSpdxElement": other})

    for control, checksum in debs:
        packages[control["Package"]] = package(
            control["Package"], control["Version"], checksum)
    for name, there in sorted(installed.items()):
        packages[name] = package(name, there)
    for control, _ in debs:
        one = identifier(control["Package"])
        relate("SPDXRef-DOCUMENT", "DESCRIBES", one)
        for name in names_of(control.get("Depends", "")):
            # What is needed to run but not to build has no version here.
            packages.setdefault(name, package(name, "NOASSERTION"))
            relate(one, "DEPENDS_ON", identifier(name))
        for name in sorted(installed):
            relate(identifier(name), "BUILD_DEPENDENCY_OF", one)
    content = hashlib.sha256("".join(
        checksum for _, checksum in debs).encode()).hexdigest()
    return {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"halfspace-{version}",
        "documentNamespace": f"urn:sha256:{content}",
        "creationInfo": {
            "created": time.astimezone(datetime.timezone.utc).strftime(
                "%Y-%m-%dT%H:%M:%SZ"),
            "creators": ["Tool: halfspace-scripts-sbom"]},
        "packages": list(packages.values()),
        "relationships": relations,
    }


def main(words):
    if len(words) != 1:
        sys.exit(__doc__)
    folder = pathlib.Path(words[0])
    debs = sorted(folder.glob("*.deb"))
    infos = list(folder.glob("*.buildinfo"))
    if not debs or len(infos) != 1:
        sys.exit(f"sbom.py: {folder} has {len(debs)} packages and {len(infos)} "
                 "build infos; run scripts/debian.sh first")
    text = infos[0].read_text()
    made = document([(control_of(deb), hashlib.sha256(
        deb.read_bytes()).hexdigest()) for deb in debs], fields_of(text))
    out = folder / f"{made['name'].replace('-', '_', 1)}.spdx.json"
    out.write_text(json.dumps(made, indent=1) + "\n")
    print(f"{out}: {len(made['packages'])} packages")


if __name__ == "__main__":
    main(sys.argv[1:])
