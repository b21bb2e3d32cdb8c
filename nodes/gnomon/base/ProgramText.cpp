// SPDX-License-Identifier: MIT
#include <gnomon/base/ProgramText.h>

#include <OpenThreads/Mutex>
#include <OpenThreads/ScopedLock>
#include <osg/FragmentProgram>
#include <osg/VertexProgram>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace gnomon {
namespace {

using Tokens = std::vector<std::string>;

constexpr const char* discard = "discard";

bool contains(const std::string& text, const char* word) { return text.find(word) != std::string::npos; }

bool cuts(const std::string& text) { return contains(text, "gl_ClipDistance") || contains(text, "gl_CullDistance"); }

bool isWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }
bool isName(const std::string& token) {
    return isWord(token[0]) && !std::isdigit(static_cast<unsigned char>(token[0]));
}

/// Past a comment or a preprocessor's line that begins at `at`; `at` if none does.
std::size_t pastComment(const std::string& text, std::size_t at) {
    const auto past = [&](const char* end, std::size_t length) {
        const std::size_t found = text.find(end, at);
        return found == std::string::npos ? text.size() : found + length;
    };
    if (text.compare(at, 2, "//") == 0 || text[at] == '#') return past("\n", 1);
    return text.compare(at, 2, "/*") == 0 ? past("*/", 2) : at;
}

/// Names and numbers, and every other sign by itself.
Tokens tokensOf(const std::string& text) {
    Tokens tokens;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t past = pastComment(text, at);
        std::size_t end = at + 1;
        if (past > at)
            end = past;
        else if (isWord(text[at])) {
            const bool number = std::isdigit(static_cast<unsigned char>(text[at]));
            while (end < text.size() && (isWord(text[end]) || (number && text[end] == '.'))) ++end;
            tokens.push_back(text.substr(at, end - at));
        } else if (!std::isspace(static_cast<unsigned char>(text[at])))
            tokens.emplace_back(1, text[at]);
        at = end;
    }
    return tokens;
}

/// Follows the vertex from its attribute to gl_Position through products with matrices. A statement of any other kind
/// makes its target something else.
class VertexWay {
public:
    VertexWay(const Tokens& tokens, const osg::Program& program) {
        for (const auto& [name, index] : program.getAttribBindingList())
            if (index == 0) _vertex.insert(name);
        _hasInOut = std::find(tokens.begin(), tokens.end(), "inout") != tokens.end();
        Tokens statement;
        for (const std::string& token : tokens)
            if (token == ";" || token == "{" || token == "}") {
                take(statement);
                statement.clear();
            } else
                statement.push_back(token);
    }

    bool arrives() const { return _vertex.count("gl_Position") > 0; }

private:
    void take(const Tokens& statement) {
        if (statement.size() < 2) return;
        declare(statement);
        bool assigns = false;
        for (std::size_t at = 1; at + 1 < statement.size(); ++at) {
            const bool compares = statement[at + 1] == "=" || isOneOf("=!<>", statement[at - 1]);
            if (statement[at] != "=" || compares) continue;
            assigns = true;
            assign(Tokens(statement.begin(), statement.begin() + long(at)),
                   Tokens(statement.begin() + long(at) + 1, statement.end()));
        }
        const bool counts = std::adjacent_find(statement.begin(), statement.end(), [](const auto& a, const auto& b) {
                                return a == b && isOneOf("+-", a);
                            }) != statement.end();
        if (counts || (!assigns && _hasInOut && isName(statement[0]) && statement[1] == "("))
            for (const std::string& token : statement) stop(token);
    }

    /// @param left  what stands before the sign, which ends with the target.
    void assign(Tokens left, const Tokens& right) {
        const bool inPlace = isOneOf("+-*/", left.back());
        if (inPlace) left.pop_back();
        bool element = false;
        for (; !left.empty() && left.back() == "]"; element = true) {
            while (!left.empty() && left.back() != "[") left.pop_back();
            if (!left.empty()) left.pop_back();
        }
        if (left.empty()) return;
        const bool member = left.size() > 2 && left[left.size() - 2] == ".";
        const std::string &last = left.back(), &target = member ? left[left.size() - 3] : last;
        if (member && !element && last == "z" && _clip.count(target) > 0) return; // x, y and w tell where it is
        const bool whole = !member && !element && !inPlace && keeps(right);
        if (!whole) return stop(target);
        _vertex.insert(target);
        if (isInClip(right))
            _clip.insert(target);
        else if (target != "gl_Position")
            _clip.erase(target);
    }

    /// Matrices that are uniforms, and the attribute of location 0.
    void declare(const Tokens& statement) {
        const auto has = [&statement](const char* word) {
            return std::find(statement.begin(), statement.end(), word) != statement.end();
        };
        const std::string& name = statement.back();
        if (has("uniform") && has("mat4") && isName(name)) _matrices.insert(name);
        const auto location = std::find(statement.begin(), statement.end(), "location");
        if (has("in") && statement.end() - location > 2 && *(location + 2) == "0") _vertex.insert(name);
    }

    bool keeps(const Tokens& right) const {
        bool vertex = false, member = false;
        for (const std::string& token : right) {
            const bool known = _vertex.count(token) > 0 || token == "ftransform";
            const bool allowed = known || isMatrix(token) || isPlain(token) || (member && isAll(token));
            if (!allowed) return false;
            vertex = vertex || known;
            member = token == ".";
        }
        return vertex;
    }

    bool isMatrix(const std::string& token) const {
        const bool builtIn = token.compare(0, 3, "gl_") == 0 || token.compare(0, 4, "osg_") == 0;
        return _matrices.count(token) > 0 || (builtIn && contains(token, "Matrix"));
    }
    static bool isPlain(const std::string& token) {
        static const std::set<std::string> plain{"*", "(", ")", ",", ".", "vec3", "vec4", "1", "1.", "1.0", "1.0f"};
        return plain.count(token) > 0;
    }
    bool isInClip(const Tokens& right) const {
        const auto isInverse = [](const std::string& token) { return contains(token, "Inverse"); };
        const auto isProjected = [this](const std::string& token) {
            return _clip.count(token) > 0 || token == "ftransform" ||
                   (isMatrix(token) && contains(token, "Projection"));
        };
        return std::none_of(right.begin(), right.end(), isInverse) &&
               std::any_of(right.begin(), right.end(), isProjected);
    }
    static bool isOneOf(const char* signs, const std::string& token) {
        return token.size() == 1 && std::strchr(signs, token[0]);
    }
    static bool isAll(const std::string& token) { return token == "xyz" || token == "xyzw" || token == "w"; }
    void stop(const std::string& name) { _vertex.erase(name); }

    std::set<std::string> _vertex{"gl_Vertex", "osg_Vertex"}, _matrices;
    std::set<std::string> _clip{"gl_Position"}; ///< those of _vertex that are in clip space, where z is depth alone.
    bool _hasInOut = false;                     ///< a function may write what it is given.
};

/// An assignment to a z, by a logarithm somewhere.
bool bendsDepth(const std::string& text, const Tokens& tokens) {
    const auto isAssigned = [&tokens](std::size_t at) { return at < tokens.size() && tokens[at] == "="; };
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i)
        if (tokens[i] == "." && tokens[i + 1] == "z" && (isAssigned(i + 2) || isAssigned(i + 3)))
            return contains(text, "log2") || contains(text, "log(") || contains(text, "log (");
    return false;
}

/// True if the text declares a uniform mat4 by one of these names, and reads it.
bool reads(const Tokens& tokens, const std::vector<MatrixUniform>& matrices) {
    if (matrices.empty()) return false;
    std::set<std::string> declared;
    bool isUniform = false, isMatrix = false; // of the statement
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const std::string& token = tokens[i];
        const bool ends = token == ";" || token == "{" || token == "}";
        isUniform = !ends && (isUniform || token == "uniform");
        isMatrix = !ends && (isMatrix || token == "mat4");
        if (!isUniform && declared.count(token) > 0) return true;
        const auto isIt = [&token](const MatrixUniform& matrix) { return matrix.name == token; };
        const bool isArray = i + 1 < tokens.size() && tokens[i + 1] == "[";
        if (isUniform && isMatrix && !isArray && std::any_of(matrices.begin(), matrices.end(), isIt))
            declared.insert(token);
    }
    return false;
}

/// A fragment's own depth is taken for OpenGL's where its text speaks of how that is made.
bool replacesDepth(const std::string& text, const std::vector<MatrixUniform>& matrices) {
    if (!contains(text, "gl_FragDepth")) return false;
    const bool asOpenGl = contains(text, "gl_DepthRange") || contains(text, "ProjectionMatrix") ||
                          contains(text, "gl_FragCoord.z") || reads(tokensOf(text), matrices);
    return contains(text, "log") || !asOpenGl;
}

/// Follows gl_FragCoord's x and y from names to names, and into the conditions under which fragments are discarded.
class PixelWay {
public:
    explicit PixelWay(const Tokens& tokens) {
        Tokens statement;
        for (const std::string& token : tokens) {
            if (token != ";" && token != "{" && token != "}") {
                statement.push_back(token);
                continue;
            }
            take(statement, token == "{");
            statement.clear();
            if (token != "}" || _blocks.empty()) continue;
            _condition = _blocks.back();
            _blocks.pop_back();
        }
    }

    /// True if all that is discarded is by the pixel: of leaves that fade the outline stays.
    bool arrives() const { return _arrives && !_discardsOtherwise; }

private:
    void take(const Tokens& statement, bool opens) {
        const auto has = [&statement](const char* word) {
            return std::find(statement.begin(), statement.end(), word) != statement.end();
        };
        const bool byPixel = isByPixel(statement) || (has("else") && _condition) ||
                             std::find(_blocks.begin(), _blocks.end(), true) != _blocks.end();
        _arrives = _arrives || (byPixel && has(discard));
        _discardsOtherwise = _discardsOtherwise || (!byPixel && has(discard));
        if (has("if")) _condition = byPixel;
        if (byPixel && has("return")) _names.insert(_function);
        if (byPixel) assign(statement);
        if (!opens) return;
        const auto bracket = std::find(statement.begin(), statement.end(), "(");
        if (_blocks.empty() && bracket != statement.end() && bracket != statement.begin()) _function = *(bracket - 1);
        _blocks.push_back(byPixel);
    }

    void assign(const Tokens& statement) {
        const auto equals = std::find(statement.begin(), statement.end(), "=");
        if (equals == statement.end()) return;
        for (auto at = equals; at != statement.begin(); --at)
            if (isName(*(at - 1)) && (at - 1 == statement.begin() || *(at - 2) != ".")) {
                _names.insert(*(at - 1));
                return;
            }
    }

    bool isByPixel(const Tokens& statement) const {
        for (std::size_t i = 0; i < statement.size(); ++i) {
            const bool depth = i + 2 < statement.size() && statement[i + 1] == "." &&
                               statement[i + 2].find_first_not_of("zw") == std::string::npos;
            if (_names.count(statement[i]) > 0 || (statement[i] == "gl_FragCoord" && !depth)) return true;
        }
        return false;
    }

    std::set<std::string> _names;
    std::vector<bool> _blocks; ///< that the statement is in: whether a pixel's place decides about each.
    std::string _function;
    bool _condition = false; ///< of the last if.
    bool _arrives = false, _discardsOtherwise = false;
};

bool takesProjection(const Tokens& tokens) {
    constexpr const char* names[] = {"ftransform", "gl_ModelViewProjectionMatrix", "gl_ProjectionMatrix",
                                     "osg_ModelViewProjectionMatrix", "osg_ProjectionMatrix"};
    const auto isGiven = [&tokens](const char* name) {
        return std::find(tokens.begin(), tokens.end(), name) != tokens.end();
    };
    return std::any_of(std::begin(names), std::end(names), isGiven);
}

/// Shaders before GLSL 1.50 have no layouts: a parameter of the program says what they make.
bool makesTriangles(const osg::Program& program) {
    for (unsigned i = 0; i < program.getNumShaders(); ++i) {
        const std::string& text = program.getShader(i)->getShaderSource();
        if (program.getShader(i)->getType() != osg::Shader::GEOMETRY) continue;
        return contains(text, "layout") ? contains(text, "triangle_strip")
                                        : program.getParameter(GL_GEOMETRY_OUTPUT_TYPE_EXT) == GL_TRIANGLE_STRIP;
    }
    return false;
}

/// @param others  texts of the stages between the two.
ProgramPlaces found(const osg::Program& program, const std::string& vertex, const std::string& fragment,
                    const std::string& others, const std::vector<MatrixUniform>& matrices) {
    const Tokens tokens = tokensOf(vertex);
    ProgramPlaces places;
    places.movesVertices = !others.empty() || (!vertex.empty() && !VertexWay(tokens, program).arrives());
    places.setsDepth = bendsDepth(vertex, tokens) || replacesDepth(fragment, matrices);
    const Tokens inFragment = contains(fragment, discard) ? tokensOf(fragment) : Tokens();
    const bool isDiscarded = std::find(inFragment.begin(), inFragment.end(), discard) != inFragment.end();
    places.discardsByPixel = isDiscarded && PixelWay(inFragment).arrives();
    places.discards =
        isDiscarded || std::any_of(tokens.begin(), tokens.end(), [](const auto& token) { return cuts(token); });
    const bool isFixed = vertex.empty() && others.empty(); // fragments alone are the program's
    const auto takes = [&matrices](const Tokens& stage) { return takesProjection(stage) || reads(stage, matrices); };
    places.takesProjection = isFixed || takes(tokens) || takes(tokensOf(others));
    return places;
}

} // namespace

ProgramPlaces placesOf(const osg::Program& program, const std::vector<MatrixUniform>& matrices) {
    std::string vertex, fragment, others;
    for (unsigned i = 0; i < program.getNumShaders(); ++i) {
        const osg::Shader& shader = *program.getShader(i);
        const bool isVertex = shader.getType() == osg::Shader::VERTEX,
                   isFragment = shader.getType() == osg::Shader::FRAGMENT;
        (isVertex ? vertex : isFragment ? fragment : others) += shader.getShaderSource() + "\n";
    }
    static OpenThreads::Mutex mutex;
    static std::map<std::size_t, ProgramPlaces> known;
    std::string all = vertex + '\0' + fragment + '\0' + others;
    for (const auto& [name, index] : program.getAttribBindingList()) all += '\0' + name + std::to_string(index);
    for (const MatrixUniform& matrix : matrices) all += '\1' + matrix.name;
    const std::size_t key = std::hash<std::string>()(all);
    const OpenThreads::ScopedLock<OpenThreads::Mutex> lock(mutex);
    if (known.size() > 1000) known.clear(); // texts that are made anew in each frame
    const auto [entry, isNew] = known.try_emplace(key);
    if (isNew) entry->second = found(program, vertex, fragment, others, matrices);
    ProgramPlaces places = entry->second;
    places.makesTriangles = !others.empty() && makesTriangles(program);
    return places;
}

bool mayDiscard(const osg::Program& program) {
    for (unsigned i = 0; i < program.getNumShaders(); ++i) {
        const osg::Shader& shader = *program.getShader(i);
        const std::string& text = shader.getShaderSource();
        if (shader.getType() == osg::Shader::FRAGMENT ? contains(text, discard) : cuts(text))
            return placesOf(program).discards;
    }
    return false;
}

bool writesClipDistance(const osg::Program& program) {
    for (unsigned i = 0; i < program.getNumShaders(); ++i)
        if (cuts(program.getShader(i)->getShaderSource())) return true;
    return false;
}

bool mayApplyProgram(const osg::StateAttribute& attribute) {
    using A = osg::StateAttribute;
    const A::Type type = attribute.getType();
    if (type == A::PROGRAM) return !dynamic_cast<const osg::Program*>(&attribute);
    if (type == A::VERTEXPROGRAM) {
        const auto* vertex = dynamic_cast<const osg::VertexProgram*>(&attribute);
        return !vertex || !contains(vertex->getVertexProgram(), "ARB_position_invariant");
    }
    if (type == A::FRAGMENTPROGRAM) {
        const auto* fragment = dynamic_cast<const osg::FragmentProgram*>(&attribute);
        return !fragment || contains(fragment->getFragmentProgram(), "KIL") ||
               contains(fragment->getFragmentProgram(), "result.depth");
    }
    return attribute.getShaderComponent() || (type > A::SAMPLER && type != A::CAPABILITY);
}

} // namespace gnomon
