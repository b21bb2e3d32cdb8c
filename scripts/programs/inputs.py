# SPDX-License-Identifier: MIT
"""What the programs of try-programs read: models, scenes, a house and a town, made here."""
import os
import subprocess

# A model in the place of OpenSceneGraph's own data, which Debian does not have.
MODEL = """#Ascii Scene
#Version 161
#Generator by hand
osg::Geode {
  UniqueID 1
  Drawables 4 {
    osg::ShapeDrawable { UniqueID 2 Shape TRUE { osg::Box { UniqueID 3 Center 0 0 0 HalfLengths 5 1 1 } } }
    osg::ShapeDrawable { UniqueID 4 Shape TRUE { osg::Box { UniqueID 5 Center 1 0 0.5 HalfLengths 1 5 0.15 } } }
    osg::ShapeDrawable { UniqueID 6 Shape TRUE { osg::Sphere { UniqueID 7 Center 4 0 1.5 Radius 1 } } }
    osg::ShapeDrawable { UniqueID 8 Shape TRUE { osg::Cylinder { UniqueID 9 Center -4 0 2 Radius 0.4 Height 3 } } }
  }
}
"""
# SUMO's roads are black: something beside them shows the shadows.
MEADOW = """#Ascii Scene
#Version 161
#Generator by hand
osg::Geode {
  UniqueID 1
  Drawables 1 {
    osg::ShapeDrawable { UniqueID 2 Shape TRUE { osg::Box { UniqueID 3 Center 0 0 0 HalfLengths 90 90 0.2 } } }
  }
}
"""
MODELS_OF_SUMO = "/usr/share/sumo/data/3D"
MODELS = ["cow.osgt", "glider.osgt", "cessna.osgt", "cessnafire.osgt", "dumptruck.osgt", "dumptruck.osg"]

SCENE_OF_DART = """import dartpy as dart
import numpy as np
world = dart.simulation.World()
for name, size, place in [("ground", [4, 4, 0.1], [0, 0, -0.05]), ("tower", [0.3, 0.3, 1.2], [0.2, 0, 0.6]),
                          ("block", [0.6, 0.4, 0.3], [-0.7, 0.4, 0.15])]:
    body = dart.dynamics.Skeleton(name)
    joint, node = body.createFreeJointAndBodyNodePair()
    shape = node.createShapeNode(dart.dynamics.BoxShape(size))
    shape.createVisualAspect().setColor([0.8, 0.8, 0.8])
    transform = dart.math.Isometry3()
    transform.set_translation(place)
    joint.setTransform(transform)
    body.setMobile(False)
    world.addSkeleton(body)
viewer = dart.gui.osg.Viewer()
viewer.addWorldNode(dart.gui.osg.WorldNode(world))
viewer.switchHeadlights(False)
viewer.setUpViewInWindow(0, 0, %d, %d)
viewer.setCameraHomePosition([3, -4, 3], [0, 0, 0.2], [0, 0, 1])
viewer.run()
"""

IFC = """ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('house.ifc','2026-01-01T00:00:00',(''),(''),'','','');
FILE_SCHEMA(('IFC4'));
ENDSEC;
DATA;
#1=IFCCARTESIANPOINT((0.,0.,0.));
#2=IFCDIRECTION((0.,0.,1.));
#3=IFCDIRECTION((1.,0.,0.));
#4=IFCAXIS2PLACEMENT3D(#1,#2,#3);
#5=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#4,$);
#6=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);
#7=IFCUNITASSIGNMENT((#6));
#8=IFCPROJECT('0000000000000000000001',$,'Project',$,$,$,$,(#5),#7);
#9=IFCLOCALPLACEMENT($,#4);
#10=IFCSITE('0000000000000000000002',$,'Site',$,$,#9,$,$,.ELEMENT.,$,$,$,$,$);
#11=IFCBUILDING('0000000000000000000003',$,'Building',$,$,#9,$,$,.ELEMENT.,$,$,$);
#12=IFCRELAGGREGATES('0000000000000000000004',$,$,$,#8,(#10));
#13=IFCRELAGGREGATES('0000000000000000000005',$,$,$,#10,(#11));
%s
ENDSEC;
END-ISO-10303-21;
"""


def write(folder, name, text):
    with open(os.path.join(folder, name), "w") as file:
        file.write(text)


def call(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, errors="replace")
    if done.returncode != 0:
        raise RuntimeError(f"{command[0]}: {done.stderr.strip()[-300:]}")


def house():
    """An IFC file: a slab, four walls and a tower, each an extruded rectangle."""
    lines, parts, number = [], [], 100
    boxes = [("IFCSLAB", 0, 0, -0.3, 30, 30, 0.3), ("IFCWALL", 0, -5, 0, 12, 0.4, 4), ("IFCWALL", 0, 5, 0, 12, 0.4, 4),
             ("IFCWALL", -6, 0, 0, 0.4, 10, 4), ("IFCWALL", 6, 0, 0, 0.4, 10, 4), ("IFCWALL", 9, 9, 0, 2, 2, 9)]
    for at, (kind, x, y, z, width, depth, height) in enumerate(boxes):
        n = number + 20 * at
        last = ",.FLOOR." if kind == "IFCSLAB" else ",$"
        lines += [f"#{n}=IFCCARTESIANPOINT(({x:.2f},{y:.2f},{z:.2f}));", f"#{n+1}=IFCAXIS2PLACEMENT3D(#{n},#2,#3);",
                  f"#{n+2}=IFCLOCALPLACEMENT(#9,#{n+1});", f"#{n+3}=IFCCARTESIANPOINT((0.,0.));",
                  f"#{n+4}=IFCDIRECTION((1.,0.));", f"#{n+5}=IFCAXIS2PLACEMENT2D(#{n+3},#{n+4});",
                  f"#{n+6}=IFCRECTANGLEPROFILEDEF(.AREA.,$,#{n+5},{width:.2f},{depth:.2f});",
                  f"#{n+7}=IFCEXTRUDEDAREASOLID(#{n+6},#4,#2,{height:.2f});",
                  f"#{n+8}=IFCSHAPEREPRESENTATION(#5,'Body','SweptSolid',(#{n+7}));",
                  f"#{n+9}=IFCPRODUCTDEFINITIONSHAPE($,$,(#{n+8}));",
                  f"#{n+10}={kind}('00000000000000000001{at:02}',$,'Part {at}',$,$,#{n+2},#{n+9},${last});"]
        parts.append(f"#{n+10}")
    lines.append(f"#90=IFCRELCONTAINEDINSPATIALSTRUCTURE('0000000000000000000006',$,$,$,({','.join(parts)}),#11);")
    return IFC % "\n".join(lines)


def prepare(kind, folder, size):
    """What a program of this kind reads, in its folder. size: of its window."""
    for name in MODELS:
        write(folder, name, MODEL)
    if kind == "dart":
        write(folder, "scene.py", SCENE_OF_DART % size)
    elif kind == "ifcplusplus":
        write(folder, "house.ifc", house())
        call(["localedef", "--quiet", "--no-warnings=ascii", "-i", "en_US", "-f", "UTF-8", os.path.join(folder, "en_US.utf8")], folder)
    elif kind == "sumo":
        prepare_town(folder)


def prepare_town(folder):
    """A small town with traffic. SUMO's package lacks five models, which any OBJ file replaces."""
    for name in ["poleBase", "tlg", "tly", "tlr", "tlu"]:
        write(folder, f"{name}.obj", "v 0 0 0\nv 0.2 0 0\nv 0 0.2 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
    call(["netgenerate", "--grid", "--grid.number", "3", "--grid.length", "60", "-o", "town.net.xml"], folder)
    write(folder, "town.rou.xml", """<routes>
<flow id="a" from="A0B0" to="B2C2" begin="0" end="200" period="2"/>
<flow id="b" from="C2C1" to="A1A0" begin="0" end="200" period="2"/>
</routes>
""")
    write(folder, "town.sumocfg", """<configuration>
<input><net-file value="town.net.xml"/><route-files value="town.rou.xml"/></input>
</configuration>
""")
    write(folder, "meadow.osgt", MEADOW)
    write(folder, "view.xml", """<viewsettings>
<viewport x="100" y="-30" z="40" centerX="60" centerY="50" centerZ="0" angle="0"/>
<decal file="meadow.osgt" centerX="60" centerY="60" centerZ="-0.5"/>
</viewsettings>
""")
