// SPDX-License-Identifier: MIT
// A program against a Gnomon that was built with Embree and without Qhull: queries answer, but for those of a technique
// that is missing.
#include <gnomon/OptionalParts.h>
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowQuery.h>
#include <gnomon/TerrainShadowGeode.h>
#include <osg/ShapeDrawable>

#include <iostream>
#include <stdexcept>

int main() {
    osg::ref_ptr<osg::Geode> box = new osg::Geode;
    box->addDrawable(new osg::ShapeDrawable(new osg::Box({0, 0, 2}, 1)));
    osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    osg::ref_ptr<gnomon::PlanarShadowNode> planar = new gnomon::PlanarShadowNode(osg::Vec4d(0, 0, 1, 0));
    osg::ref_ptr<gnomon::TerrainShadowGeode> hull = new gnomon::TerrainShadowGeode;
    for (osg::Node* node :
         {static_cast<osg::Node*>(box), static_cast<osg::Node*>(planar), static_cast<osg::Node*>(hull)})
        group->addChild(node);
    const gnomon::ShadowLight above{0, {0, 0, 1, 0}};
    if (gnomon::ShadowQuery(*planar, above).isLit({0, 0, 0})) return std::cerr << "no shadow below the box\n", 1;
    try {
        gnomon::ShadowQuery query(*hull, above);
        return std::cerr << "a query of hull is made without Qhull\n", 1;
    } catch (const std::runtime_error& failure) {
        if (failure.what() == gnomon::whyMissing(gnomon::OptionalPart::Terrain)) return 0;
        return std::cerr << "a query of hull says: " << failure.what() << '\n', 1;
    }
}
