# SPDX-License-Identifier: MIT
"""The programs of try-programs, and how each is called."""

WIDTH, HEIGHT = 400, 300  # of their windows, where they take it from OSG_WINDOW


class Program:
    """options: of gnomonrun. package: of Debian; the examples' sources are built first. frames: the last one is compared.

    unshadowed: why nothing in its scene is in shadow; empty if something is.
    """

    def __init__(self, name, command, package, frames=20, environment=None, options=(), unshadowed=""):
        self.name, self.command, self.package, self.frames = name, command, package, frames
        self.environment, self.options, self.unshadowed = environment or {}, list(options), unshadowed

    @property
    def is_example(self):
        return self.package == "openscenegraph-examples"


def example(name, *arguments, frames=20, unshadowed=""):
    return Program(name, [name, *arguments], "openscenegraph-examples", frames, unshadowed=unshadowed)


QUICK = ["osgcompositeviewer", "osgshape", "osggeometry", "osgprerender", "osgcallback", "osghud", "osgscribe", "osgreflect",
         "osganimate", "osgmultitexture"]

PROGRAMS = [
    Program("sumo", ["sumo-gui", "--osg-view", "-c", "town.sumocfg", "--start", "--breakpoints", "30", "-g", "view.xml",
                     "--window-size", "800,800"], "sumo", frames=400,
            options=["--light", "-1,-0.4,0.4,0"]),
    Program("dart", ["/usr/bin/python3", "scene.py"], "python3-dartpy"),
    Program("ifcplusplus", ["SimpleViewerExample", "house.ifc"], "ifcplusplus", frames=400,
            environment={"LC_ALL": "en_US.UTF-8"}, options=["--light", "-1,2,1.5,0"]),
    example("osgcompositeviewer", "cow.osgt", "-3"),
    Program("osgviewer", ["osgviewer", "cow.osgt"], "openscenegraph"),
    example("osganimate"),
    example("osganimationsolid"),
    example("osgbillboard"),
    example("osgblendequation", "cow.osgt"),
    example("osgcallback", "cow.osgt"),
    example("osgcamera", "cow.osgt"),
    example("osgcubemap", "cow.osgt"),
    example("osgdepthpartition"),
    example("osgdistortion", "cow.osgt"),
    example("osgdrawinstanced", unshadowed="a vertex shader places its quads"),
    example("osgforest"),
    example("osgfpdepth", "cow.osgt"),
    example("osggeometry"),
    example("osggeometryshaders"),
    example("osghangglide"),
    example("osghud", "cow.osgt"),
    example("osglight"),
    example("osglogicop", "cow.osgt"),
    example("osgmultiplerendertargets"),
    example("osgmultitexture", "cow.osgt"),
    example("osgoit", "dumptruck.osg"),
    example("osgparametric"),
    example("osgparticle"),
    example("osgplanets"),
    example("osgprerender", frames=60),
    example("osgreflect", "cow.osgt"),
    example("osgscribe", "cow.osgt"),
    example("osgsequence", "cow.osgt", "glider.osgt"),
    example("osgshape"),
    example("osgsimpleshaders"),
    example("osgspheresegment"),
    example("osgspotlight"),
    example("osgteapot"),
    example("osgtessellate"),
    example("osgtext"),
    example("osgthirdpersonview", "cow.osgt"),
]
