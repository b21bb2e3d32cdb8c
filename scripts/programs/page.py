# SPDX-License-Identifier: MIT
"""The guide's page "Programs tried", made from what try-programs found. Needs ImageMagick."""
import os
import subprocess

LARGE = ["sumo", "dart", "ifcplusplus", "osgcompositeviewer"]
PEER = "osgShadow::ShadowMap"
CALLED = {"sumo": "SUMO, traffic", "dart": "DART, robotics", "ifcplusplus": "IFC++, buildings",
          "osgcompositeviewer": "osgcompositeviewer, three views"}

HEAD = """# Programs tried

{count} finished programs, none of which knows Gnomon, were run with shadows by [gnomonrun](../files-and-viewers.md#gnomonrun).
{examples} of them are examples of OpenSceneGraph, built from the sources that Debian has. The others are Debian's own
programs. `scripts/try-programs --page docs/evidence` runs all of them and writes this page.

{verdict}

- No program crashes, and none draws with an OpenGL error that it has not without shadows.
- No pixel is brighter with shadows than without.
- `map` and `traced` agree away from edges, to 0.1 % of the picture, unless a caster draws itself.
- Something is in shadow, and each technique shows that or says why it does not.

`./check programs` repeats the trial. Ten of the programs are among the tests.

## Four of them

| program | without shadows | `map` | osgShadow::ShadowMap |
| --- | --- | --- | --- |
{large}

*Each picture is of one frame. DART and IFC++ show what the trial wrote for them: boxes, and a house of four walls. SUMO shows traffic
on black roads, and a meadow that the trial wrote. SUMO and IFC++ have a light of gnomonrun's `--light`.*

## All of them

Each strip shows the frame without shadows, with `map`, and with osgShadow::ShadowMap.

| program | pictures | `map` | `volume` | `traced` | darker by ShadowMap | brighter by ShadowMap | `volume` apart | Gnomon says |
| --- | --- | --- | --- | --- | --- | --- | --- | --- |
{rows}

*Pixels darker with `relight`, frame 20 (SUMO and IFC++: frame 400, osgprerender: 60). "Brighter": pixels that are
brighter than without shadows. "`volume` apart": pixels away from edges where `volume` and `traced` differ. Mesa's llvmpipe, OpenSceneGraph 3.6.5. A sun stands at azimuth 135°, elevation 45° if the
program's only light is at the eye.*

`volume` and `traced` differ away from edges in osgdepthpartition. It has an earth and a sun at their true distance. Floats hold casters
of such a scene to kilometres, so `traced` and `map` leave facets at the terminator lit. `volume` has them in shadow.

osgsimpleshaders shrinks its block by a program. `map` casts it where it is drawn, and it has no shadow; `volume` and `traced` cast it
where its arrays stand, about what is drawn, and say so.
"""

# What the causes of diagnose() have in common, and how the table has it. The first that fits counts.
SAYINGS = [("casts nothing", "draws itself: only maps cast it"), ("is unlit or its program does not read", "unlit: multiplied"),
           ("nothing casts", "nothing casts"), ("no light is on", "no light is on"), ("is black", "lights are black"),
           ("cleared to less than 1", "depth is inverted"), ("stencil test of its own", "blends instead"),
           ("a logic operation combines", "a logic operation combines it")]


def convert(*arguments):
    subprocess.run(["convert", *arguments], check=True)


def picture_of(work, program, result, name):
    file = next(each["file"] for each in result["drawn"] if each["name"] == name)
    return os.path.join(work, "run", program.name, "compared", file)


def write_pictures(folder, work, program, result):
    small = ["-alpha", "off", "-resize", "160x120", "-background", "white", "-gravity", "center", "-extent", "160x120"]
    shown = [picture_of(work, program, result, name) for name in ("none", "map", PEER)]
    plain = ["-strip", "-quality", "85"]
    convert(*shown, *small, "+append", *plain, os.path.join(folder, program.name + ".jpg"))
    if program.name in LARGE:
        for name, source in zip(("none", "map", "peer"), shown):
            convert(source, "-alpha", "off", "-resize", "320x240", *plain, os.path.join(folder, f"{program.name}-{name}.jpg"))


def said(drawn):
    causes = [cause for name in ("map", "volume", "traced") for cause in drawn[name]["causes"]]
    known = (text for part, text in SAYINGS if any(part in cause for cause in causes))
    return next(known, "see `diagnose()`" if causes else "")


def row(program, result):
    drawn = {each["name"]: each for each in result["drawn"]}
    dark = " | ".join(f"{drawn[name]['darker']:,}" for name in ("map", "volume", "traced", PEER))
    return f"| {program.name} | ![{program.name}](programs/{program.name}.jpg) | {dark} | {drawn[PEER]['brighter']:,} | " \
           f"{result['disagree']['volume']['traced']:,} | " \
           f"{said(drawn) or program.unshadowed} |"


def large_row(program):
    pictures = " | ".join(f"![{program.name}, {title}](programs/{program.name}-{name}.jpg)" for name, title in
                          (("none", "without shadows"), ("map", "map"), ("peer", "ShadowMap")))
    return f"| {CALLED[program.name]} | {pictures} |"


def verdict(tried):
    failed = [program.name for program, (_, faults) in tried if faults]
    if not failed:
        return "This holds for each of them, with every technique and both composites:"
    return f"This holds with every technique and both composites, but for {', '.join(failed)}:"


def write(docs, work, tried):
    """tried: pairs of a program, and its result and faults."""
    folder = os.path.join(docs, "programs")
    os.makedirs(folder, exist_ok=True)
    drawn = [(program, result) for program, (result, _) in tried if result]
    for program, result in drawn:
        write_pictures(folder, work, program, result)
    with open(os.path.join(docs, "programs.md"), "w") as file:
        file.write(HEAD.format(
            count=len(tried), examples=sum(program.is_example for program, _ in tried), verdict=verdict(tried),
            large="\n".join(large_row(program) for program, _ in drawn if program.name in LARGE),
            rows="\n".join(row(program, result) for program, result in drawn)))
