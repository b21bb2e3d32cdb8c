// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/NamedNode.h>

#include <stdexcept>

namespace gnomon::examples {

/// The first node of a scene with this name, of whatever class it is to be put into.
struct Named {
    osg::Node& scene;
    const char* name;

    /// @throws std::runtime_error, one sentence, if there is none: the scene's file is not the program's own.
    template <class Class>
    operator osg::ref_ptr<Class>() const {
        const auto found = findNamed(scene, name);
        auto* node = found ? dynamic_cast<Class*>(found->node.get()) : nullptr;
        if (!node)
            throw std::runtime_error(std::string("the scene has no ") + name +
                                     " of the needed kind. Use the scene file that comes with the program.");
        return node;
    }
};

inline Named named(osg::Node& scene, const char* name) { return {scene, name}; }

} // namespace gnomon::examples
