// SPDX-License-Identifier: MIT
// What the text of a program says of where its vertices and its depths go.
#include <gnomon/base/ProgramText.h>

#include <gtest/gtest.h>

namespace {

osg::ref_ptr<osg::Program> programOf(const std::string& vertex, const std::string& fragment = "") {
    osg::ref_ptr<osg::Program> program = new osg::Program;
    if (!vertex.empty()) program->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
    if (!fragment.empty()) program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
    return program;
}

bool moves(const std::string& vertex) { return gnomon::placesOf(*programOf(vertex)).movesVertices; }
bool bends(const std::string& vertex, const std::string& fragment = "") {
    return gnomon::placesOf(*programOf(vertex, fragment)).setsDepth;
}

} // namespace

TEST(ProgramText, MatricesLeaveVerticesInTheirPlace) {
    EXPECT_FALSE(moves("void main() { gl_Position = ftransform(); }"));
    EXPECT_FALSE(moves("void main() { gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex; }"));
    EXPECT_FALSE(moves("#version 130\nin vec4 osg_Vertex; uniform mat4 osg_ModelViewProjectionMatrix;\n"
                       "void main() { gl_Position = osg_ModelViewProjectionMatrix * vec4(osg_Vertex.xyz, 1.0); }"));
    EXPECT_FALSE(moves("varying vec3 at; void main() { vec4 eye = gl_ModelViewMatrix * gl_Vertex; at = eye.xyz;\n"
                       "gl_Position = gl_ProjectionMatrix * eye; gl_TexCoord[0] = gl_MultiTexCoord0; }"));
    EXPECT_FALSE(moves("#version 330\nlayout(location = 0) in vec3 place; uniform mat4 clipFromLocal;\n"
                       "void main() { gl_Position = clipFromLocal * vec4(place, 1.0); }"));
    EXPECT_FALSE(gnomon::placesOf(*programOf("", "void main() { gl_FragColor = vec4(1.0); }")).movesVertices);
}

TEST(ProgramText, AnAttributeIsTheVertexWhereTheProgramBindsItToLocationZero) {
    const std::string text =
        "attribute vec4 place; void main() { gl_Position = gl_ModelViewProjectionMatrix * place; }";
    for (const unsigned location : {0u, 6u, 0u}) {
        const osg::ref_ptr<osg::Program> program = programOf(text);
        program->addBindAttribLocation("place", location);
        EXPECT_EQ(gnomon::placesOf(*program).movesVertices, location != 0) << location;
    }
    EXPECT_TRUE(moves(text));
}

TEST(ProgramText, InstancesBonesAndWavesMoveThem) {
    EXPECT_TRUE(moves("#version 140\nvoid main() { vec4 v = gl_Vertex; v.x += 3.0 * float(gl_InstanceID);\n"
                      "gl_Position = gl_ModelViewProjectionMatrix * v; }"));
    EXPECT_TRUE(moves("uniform mat4 matrixPalette[8]; attribute vec4 bones;\n"
                      "void main() { vec4 v = matrixPalette[int(bones.x)] * gl_Vertex;\n"
                      "gl_Position = gl_ModelViewProjectionMatrix * v; }"));
    EXPECT_TRUE(moves("uniform float time; void main() {\n"
                      "gl_Position = gl_ModelViewProjectionMatrix * (gl_Vertex + vec4(0, 0, sin(time), 0)); }"));
}

TEST(ProgramText, MapsLetThoseMoveThatTakeTheProjection) {
    const auto follows = [](const std::string& vertex, const std::string& fragment = "") {
        return gnomon::placesOf(*programOf(vertex, fragment)).castsWhereItMoves();
    };
    const std::string raised = "vec4 v = gl_Vertex; v.z += 1.0; gl_Position = ";
    EXPECT_TRUE(follows("void main() { " + raised + "gl_ModelViewProjectionMatrix * v; }"));
    EXPECT_TRUE(follows("uniform mat4 osg_ProjectionMatrix, eyeFromLocal; void main() { " + raised +
                        "osg_ProjectionMatrix * eyeFromLocal * v; }"));
    EXPECT_FALSE(follows("uniform mat4 clipFromLocal; void main() { " + raised + "clipFromLocal * v; }"));
    EXPECT_FALSE(follows("void main() { gl_Position = ftransform(); }")) << "moves nothing";
    EXPECT_FALSE(follows("void main() { " + raised + "gl_ModelViewProjectionMatrix * v; }",
                         "void main() { if (fract(gl_FragCoord.x * 0.5) > 0.4) discard; }"));
    EXPECT_FALSE(follows("void main() { " + raised +
                         "gl_ModelViewProjectionMatrix * v;\n"
                         "gl_Position.z = log2(gl_Position.w) * gl_Position.w; }"));
}

TEST(ProgramText, NamedUniformsCountAsTheProjectionWhereTheyAreReadAsMatrices) {
    const auto follows = [](const std::string& declared, const std::string& fragment = "") {
        const std::string vertex =
            declared + " void main() { vec4 v = gl_Vertex; v.z += 1.0; gl_Position = mvp * other * v; }";
        return gnomon::placesOf(*programOf(vertex, fragment), {{"mvp"}}).castsWhereItMoves();
    };
    EXPECT_TRUE(follows("uniform mat4 mvp;"));
    EXPECT_TRUE(follows("layout(location = 3) uniform highp mat4 other, mvp;"));
    EXPECT_FALSE(follows("uniform mat4 other; /* uniform mat4 mvp; */"));
    EXPECT_FALSE(follows("uniform mat4 mvp[2];"));
    EXPECT_FALSE(follows("uniform mat3 mvp;"));
    EXPECT_FALSE(follows("uniform Matrices { mat4 mvp; };")) << "a block's";
    EXPECT_FALSE(follows("const mat4 mvp = mat4(1.0);"));
    EXPECT_FALSE(follows("uniform mat4 mvp;", "void main() { if (fract(gl_FragCoord.x * 0.5) > 0.4) discard; }"));
    const osg::ref_ptr<osg::Program> unread =
        programOf("uniform mat4 mvp, mine; void main() { gl_Position = mine * (gl_Vertex + 1.0); }");
    EXPECT_FALSE(gnomon::placesOf(*unread, {{"mvp"}}).castsWhereItMoves());
    EXPECT_FALSE(gnomon::placesOf(*unread).castsWhereItMoves());
    EXPECT_TRUE(gnomon::placesOf(*unread, {{"mvp"}, {"mine"}}).castsWhereItMoves());
}

TEST(ProgramText, ADepthByANamedProjectionIsOpenGLs) {
    const osg::ref_ptr<osg::Program> program =
        programOf("varying vec4 eye; void main() { eye = gl_ModelViewMatrix * gl_Vertex; gl_Position = ftransform(); }",
                  "varying vec4 eye; uniform mat4 lens; void main() { vec4 clip = lens * eye;\n"
                  "gl_FragDepth = 0.5 * clip.z / clip.w + 0.5; gl_FragColor = vec4(1.0); }");
    EXPECT_TRUE(gnomon::placesOf(*program).setsDepth);
    EXPECT_FALSE(gnomon::placesOf(*program, {{"lens", gnomon::MatrixUniform::PROJECTION}}).setsDepth);
}

TEST(ProgramText, AGeometryShaderMayMakeTriangles) {
    const auto makes = [](const std::string& text, int output) {
        const osg::ref_ptr<osg::Program> program = programOf("void main() { gl_Position = ftransform(); }");
        program->addShader(new osg::Shader(osg::Shader::GEOMETRY, text));
        program->setParameter(GL_GEOMETRY_OUTPUT_TYPE_EXT, output);
        return gnomon::placesOf(*program).makesTriangles;
    };
    const std::string in = "#version 150\nlayout(points) in; layout(", out = ", max_vertices = 3) out; void main() {}";
    EXPECT_TRUE(makes(in + "triangle_strip" + out, GL_LINE_STRIP));
    EXPECT_FALSE(makes(in + "line_strip" + out, GL_TRIANGLE_STRIP));
    EXPECT_TRUE(makes("void main() {}", GL_TRIANGLE_STRIP));
    EXPECT_FALSE(makes("void main() {}", GL_LINE_STRIP));
    EXPECT_FALSE(gnomon::placesOf(*programOf("void main() { gl_Position = ftransform(); }")).makesTriangles);
}

TEST(ProgramText, EachWayToWriteAPartOfThemMovesThem) {
    const std::string then = " gl_Position = gl_ModelViewProjectionMatrix * v; }";
    for (const std::string way :
         {"v.z += 2.0;", "v.z = 3.0;", "v.z = 0.5 * sin(v.x);", "v.z++;", "++v.z;", "v.b += 2.0;", "v.p *= 2.0;",
          "v[2] += 2.0;", "v.yz = vec2(1.0);", "v.xyz[2] = 1.0;", "v += vec4(0.0, 0.0, 2.0, 0.0);",
          "if (v.x == 0.0) v.z = 1.0;", "if (v.x <= 0.0) v.z -= 1.0;"})
        EXPECT_TRUE(moves("void main() { vec4 v = gl_Vertex; " + way + then)) << way;
    EXPECT_TRUE(moves("void lift(inout vec4 p) { p.z += 2.0; }\nvoid main() { vec4 v = gl_Vertex; lift(v);" + then));
    EXPECT_TRUE(moves("void main() { vec4 v = gl_ModelViewMatrix * gl_Vertex; v.z += 2.0;\n"
                      "gl_Position = gl_ProjectionMatrix * v; }"))
        << "an eye's z is a place";
    EXPECT_FALSE(moves("void main() { vec4 v = gl_Vertex; float h = v.z; if (v.z == 1.0) h += 1.0;\n"
                       "for (int i = 0; i < 3; ++i) h *= 2.0; gl_FrontColor = vec4(h);" +
                       then));
}

TEST(ProgramText, DepthAloneIsWrittenInClipSpace) {
    EXPECT_FALSE(moves("void main() { gl_Position = ftransform(); gl_Position.z -= 0.01; }"));
    EXPECT_FALSE(moves("void main() { vec4 c = gl_ModelViewProjectionMatrix * gl_Vertex; c.z -= 0.01 * c.w;\n"
                       "gl_Position = c; }"));
    EXPECT_FALSE(moves("uniform mat4 all; void main() { gl_Position = all * gl_Vertex; gl_Position.z = 0.0; }"));
    EXPECT_TRUE(moves("void main() { gl_Position = ftransform(); gl_Position.y -= 0.01; }"));
    EXPECT_TRUE(moves("void main() { vec4 c = gl_ModelViewProjectionMatrix * gl_Vertex;\n"
                      "vec4 v = gl_ModelViewProjectionMatrixInverse * c; v.z += 1.0;\n"
                      "gl_Position = gl_ModelViewProjectionMatrix * v; }"));
}

TEST(ProgramText, AClipDistanceDiscards) {
    const auto discards = [](const char* text) { return gnomon::mayDiscard(*programOf(text)); };
    EXPECT_TRUE(discards("void main() { gl_Position = ftransform(); gl_ClipDistance[0] = 1.0 - gl_Vertex.z; }"));
    EXPECT_FALSE(discards("void main() { gl_Position = ftransform(); } // gl_ClipDistance"));
}

TEST(ProgramText, AnotherStageMayMoveThem) {
    const osg::ref_ptr<osg::Program> program = programOf("void main() { gl_Position = ftransform(); }");
    program->addShader(new osg::Shader(osg::Shader::GEOMETRY, "void main() {}"));
    EXPECT_TRUE(gnomon::placesOf(*program).movesVertices);
}

TEST(ProgramText, ALogarithmOrAnOwnFragmentDepthReplacesOpenGLs) {
    const std::string plain = "void main() { gl_Position = ftransform(); }";
    const std::string log = "uniform float far; void main() { gl_Position = ftransform();\n"
                            "gl_Position.z = log2(max(1e-6, gl_Position.w + 1.0)) * 2.0 / log2(far + 1.0) - 1.0;\n"
                            "gl_Position.z *= gl_Position.w; }";
    EXPECT_TRUE(bends(log));
    EXPECT_FALSE(moves(log));
    EXPECT_TRUE(bends(plain, "varying float w; void main() { gl_FragDepth = log2(w) * 0.1; }"));
    EXPECT_TRUE(bends(plain, "varying float z; void main() { gl_FragDepth = z / 1000.0; }"));
    EXPECT_FALSE(bends(plain));
    EXPECT_FALSE(bends("void main() { gl_Position = ftransform(); gl_Position.z = gl_Position.w; }")); // a sky
    EXPECT_FALSE(bends(plain, "varying vec4 eye; void main() { vec4 c = gl_ProjectionMatrix * eye;\n"
                              "gl_FragDepth = 0.5 * c.z / c.w + 0.5; }"));
}

TEST(ProgramText, CommentsSayNothing) {
    EXPECT_FALSE(moves("// v.x += gl_InstanceID;\nvoid main() { /* gl_Position = x; */ gl_Position = ftransform(); }"));
}

TEST(ProgramText, AProjectionIsTakenByItsWholeName) {
    const auto takes = [](const std::string& vertex) {
        return gnomon::placesOf(*programOf(vertex, "")).takesProjection;
    };
    EXPECT_TRUE(takes("void main() { gl_Position = gl_ProjectionMatrix * (gl_ModelViewMatrix * gl_Vertex + off); }"));
    EXPECT_FALSE(takes("// not gl_ProjectionMatrix\nvoid main() { gl_Position = own * (gl_Vertex + off); }"));
    EXPECT_FALSE(
        takes("void main() { at = gl_ProjectionMatrixInverse * gl_Vertex; gl_Position = own * (gl_Vertex + off); }"));
}

TEST(ProgramText, AScreenDoorDiscardsByTheFragmentsPlaceInThePicture) {
    const auto byPixel = [](const std::string& fragment) {
        const gnomon::ProgramPlaces places = gnomon::placesOf(*programOf("", fragment));
        EXPECT_TRUE(places.discards) << fragment;
        return places.discardsByPixel;
    };
    EXPECT_TRUE(byPixel("uniform float fade; void main() { if (fract(gl_FragCoord.x * 0.5) >= fade) discard; }"));
    EXPECT_TRUE(
        byPixel("uniform float fade; uniform bool other; float door(vec2 p) { return mod(p.x + p.y, 2.0); }\n"
                "void main() { float t = door(floor(gl_FragCoord.xy)); if (other ? t < fade : t >= fade) discard; }"));
    EXPECT_TRUE(byPixel("uniform float fade; float door() { vec2 p = gl_FragCoord.xy; return mod(p.x, 2.0); }\n"
                        "void main() { if (fade < door()) { gl_FragColor = vec4(0.0); discard; } }"));
    EXPECT_TRUE(
        byPixel("void main() { float x = mod(gl_FragCoord.x, 2.0); bool kept = false; if (x > 1.0) { kept = true; }\n"
                "if (!kept) discard; }"));
    EXPECT_TRUE(byPixel("void main() { if (gl_FragCoord.x > 4.0) gl_FragColor = vec4(1.0); else discard; }"));
    EXPECT_FALSE(
        byPixel("uniform sampler2D t, light; varying vec2 at; void main() { if (texture2D(t, at).a < 0.5) discard;\n"
                "gl_FragColor = texture2D(light, gl_FragCoord.xy / 512.0); }"));
    EXPECT_FALSE(byPixel(
        "uniform sampler2D t; uniform float fade; varying vec2 at; void main() { if (texture2D(t, at).a < 0.5)\n"
        "discard; if (fract(gl_FragCoord.x * 0.5) >= fade) discard; }"))
        << "leaves keep their outline";
    EXPECT_FALSE(byPixel("void main() { if (gl_FragCoord.z > 0.5) discard; gl_FragColor = vec4(gl_FragCoord.x); }"));
    EXPECT_FALSE(byPixel("varying vec2 at; float shade() { return gl_FragCoord.y; } float cut(vec2 p) { return p.x; }\n"
                         "void main() { if (cut(at) < 0.5) { discard; } gl_FragColor = vec4(shade()); }"));
}
