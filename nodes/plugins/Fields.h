// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CompositorOptions.h>
#include <gnomon/Selection.h>

#include <osg/Notify>
#include <osgDB/ClassInterface>
#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>
#include <osgDB/Serializer>

#include <charconv>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// What the wrappers share: numbers, lists and selections in files.
namespace gnomon::fields {

/// OSG's own text has six digits and is read without correct rounding. These keep every bit: the shortest text that
/// reads back as the same number.
template <typename Number>
void writeExact(osgDB::OutputStream& out, Number value) {
    if (out.isBinary()) {
        out << value;
        return;
    }
    char text[32];
    out << std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

/// Text that is no number makes the whole file refused.
template <typename Number>
Number readExact(osgDB::InputStream& in) {
    Number value{};
    if (in.isBinary()) {
        in >> value;
        return value;
    }
    std::string word;
    in >> word;
    const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
    if (result.ec != std::errc() || result.ptr != word.data() + word.size())
        in.throwException("gnomon: '" + word + "' is not a number.");
    return value;
}

template <typename Vector>
void writeExactVector(osgDB::OutputStream& out, const Vector& vector) {
    for (int i = 0; i < Vector::num_components; ++i) writeExact(out, vector[i]);
}

template <typename Vector>
Vector readExactVector(osgDB::InputStream& in) {
    Vector vector;
    for (int i = 0; i < Vector::num_components; ++i) vector[i] = readExact<typename Vector::value_type>(in);
    return vector;
}

/// Its length, then an item a line between brackets.
template <typename Item, typename WriteItem>
bool writeList(osgDB::OutputStream& out, const std::vector<Item>& list, WriteItem writeItem) {
    out.writeSize(list.size());
    out << out.BEGIN_BRACKET << std::endl;
    for (const Item& item : list) {
        writeItem(item);
        out << std::endl;
    }
    out << out.END_BRACKET << std::endl;
    return true;
}

/// Stops where the file fails: a length that is garbage costs nothing.
template <typename ReadItem>
auto readList(osgDB::InputStream& in, ReadItem readItem) {
    std::vector<decltype(readItem())> list;
    const unsigned size = in.readSize();
    in >> in.BEGIN_BRACKET;
    for (unsigned i = 0; i < size && !in.getException(); ++i) list.push_back(readItem());
    in >> in.END_BRACKET;
    return list;
}

/// The node is written as an object: where it stands in the graph too, the file refers to it by its number.
bool writeSelection(osgDB::OutputStream& out, const Selection& selection);
Selection readSelection(osgDB::InputStream& in);
/// A selection's other nodes. The getter's selection has been read before.
bool writeOthers(osgDB::OutputStream& out, const Selection& selection);
Selection withOthers(osgDB::InputStream& in, Selection selection);

/// Reserved stencil bits, filter.
bool writeOptions(osgDB::OutputStream& out, const CompositorOptions& options);
CompositorOptions readOptions(osgDB::InputStream& in);

/// Warns of a technique that has been read, if this build lacks a library for it.
class UnavailableWarning : public osgDB::FinishedObjectReadCallback {
public:
    void objectRead(osgDB::InputStream& in, osg::Object& object) override;
};

/// Keeps a class's getCompositorOptions(), where they are not the defaults.
template <typename Class>
void addCompositorOptions(osgDB::ObjectWrapper& wrapper) {
    const auto check = [](const Class& node) { return node.getCompositorOptions() != CompositorOptions(); };
    const auto read = [](osgDB::InputStream& in, Class& node) {
        node.setCompositorOptions(readOptions(in));
        return true;
    };
    const auto write = [](osgDB::OutputStream& out, const Class& node) {
        return writeOptions(out, node.getCompositorOptions());
    };
    wrapper.addSerializer(new osgDB::UserSerializer<Class>("CompositorOptions", check, read, write),
                          osgDB::BaseSerializer::RW_USER);
}

/// Keeps a class's selection, where it has one, and as `Other…` its other nodes.
template <typename Class, Selection (Class::*get)() const, void (Class::*set)(const Selection&)>
void addSelection(osgDB::ObjectWrapper& wrapper, const std::string& name) {
    const auto check = [](const Class& node) { return (node.*get)() != Selection(); };
    const auto read = [](osgDB::InputStream& in, Class& node) {
        (node.*set)(readSelection(in));
        return true;
    };
    const auto write = [](osgDB::OutputStream& out, const Class& node) { return writeSelection(out, (node.*get)()); };
    const auto checkOthers = [](const Class& node) { return !(node.*get)().others.empty(); };
    const auto readOthers = [](osgDB::InputStream& in, Class& node) {
        (node.*set)(withOthers(in, (node.*get)()));
        return true;
    };
    const auto writeOther = [](osgDB::OutputStream& out, const Class& node) { return writeOthers(out, (node.*get)()); };
    wrapper.addSerializer(new osgDB::UserSerializer<Class>(name.c_str(), check, read, write),
                          osgDB::BaseSerializer::RW_USER);
    wrapper.addSerializer(
        new osgDB::UserSerializer<Class>(("Other" + name).c_str(), checkOthers, readOthers, writeOther),
        osgDB::BaseSerializer::RW_USER);
}

/// A number or a vector of numbers that keeps every bit in text as well.
template <typename Class, typename Value, typename Base>
class Exact : public Base {
public:
    using Base::Base;

    bool read(osgDB::InputStream& in, osg::Object& object) override {
        const typename Base::Setter setter = this->_setter;
        if (in.isBinary() || in.matchString(this->_name)) (OBJECT_CAST<Class&>(object).*setter)(readAs(in));
        return true;
    }

    bool write(osgDB::OutputStream& out, const osg::Object& object) override {
        const typename Base::Getter getter = this->_getter;
        const Value value = (OBJECT_CAST<const Class&>(object).*getter)();
        if (!out.isBinary() && value == this->_defaultValue) return true;
        out << out.PROPERTY(this->_name.c_str());
        if constexpr (std::is_arithmetic_v<Value>)
            writeExact(out, value);
        else
            writeExactVector(out, value);
        out << std::endl;
        return true;
    }

private:
    static Value readAs(osgDB::InputStream& in) {
        if constexpr (std::is_arithmetic_v<Value>)
            return readExact<Value>(in);
        else
            return readExactVector<Value>(in);
    }
};

/// A property that a class had in an earlier version. A reader passes over it, and says so if it was not the usual value. Binary
/// files, where properties have no names, keep its place with that.
template <typename Value>
class GoneProperty : public osgDB::BaseSerializer {
public:
    /// @param now  what holds instead, for a sentence.
    GoneProperty(std::string name, Value usual, std::string now)
        : BaseSerializer(READ_WRITE_PROPERTY), _name(std::move(name)), _usual(usual), _now(std::move(now)) {}
    const std::string& getName() const override { return _name; }

    bool read(osgDB::InputStream& in, osg::Object& object) override {
        if (!in.isBinary() && !in.matchString(_name)) return true;
        Value value = _usual;
        if constexpr (std::is_same_v<Value, double>)
            value = readExact<double>(in);
        else
            in >> value;
        if (value != _usual)
            OSG_NOTICE << "gnomon: " << _name << " of '" << object.getName() << "' has no effect any more: " << _now
                       << "." << std::endl;
        return true;
    }
    bool write(osgDB::OutputStream& out, const osg::Object&) override {
        if (out.isBinary()) out << _usual;
        return true;
    }

private:
    const std::string _name;
    const Value _usual;
    const std::string _now;
};

template <typename Value>
void addGone(osgDB::ObjectWrapper& wrapper, const char* name, Value usual, const char* now) {
    wrapper.addSerializer(new GoneProperty<Value>(name, usual, now), osgDB::BaseSerializer::RW_USER);
}

/// What a new object has.
template <typename Class, typename Given>
std::decay_t<Given> fresh(Given (Class::*get)() const) {
    const osg::ref_ptr<const Class> object = new Class;
    return (object.get()->*get)();
}

/// Adds a property that is Exact.
template <typename Class, typename Given>
void addExact(osgDB::ObjectWrapper& wrapper, const char* property, Given (Class::*get)() const,
              void (Class::*set)(Given)) {
    using Value = std::decay_t<Given>;
    using Base = std::conditional_t<std::is_reference_v<Given>, osgDB::PropByRefSerializer<Class, Value>,
                                    osgDB::PropByValSerializer<Class, Value>>;
    wrapper.addSerializer(new Exact<Class, Value, Base>(property, fresh(get), get, set), osgDB::getTypeEnum<Value>());
}

/// Adds a property whose values have names.
template <typename Class, typename Value>
void addEnum(osgDB::ObjectWrapper& wrapper, const char* property, Value (Class::*get)() const,
             void (Class::*set)(Value), std::initializer_list<std::pair<const char*, Value>> names) {
    osg::ref_ptr serializer = new osgDB::EnumSerializer<Class, Value, void>(property, fresh(get), get, set);
    for (const auto& [name, value] : names) serializer->add(name, value);
    wrapper.addSerializer(serializer, osgDB::BaseSerializer::RW_ENUM);
}

} // namespace gnomon::fields

/// Registers the wrapper of gnomon::NAME. The body of a function that adds properties to `wrapper` follows. It stands
/// outside of namespaces.
/// @param OSG_BASES  names of OSG's classes that it inherits, the first one first.
/// @param KIT_BASES  the same of the kit's classes.
#define GNOMON_WRAPPER(NAME, CREATE, OSG_BASES, KIT_BASES)                                                             \
    namespace NAME##Fields {                                                                                           \
        void addProperties(osgDB::ObjectWrapper* wrapper);                                                             \
        REGISTER_CUSTOM_OBJECT_WRAPPER(gnomon, gnomon_##NAME, CREATE, gnomon::NAME,                                    \
                                       OSG_BASES " gnomon::FileVersion " KIT_BASES " gnomon::" #NAME) {                \
            static_cast<void>(domain);                                                                                 \
            addProperties(wrapper);                                                                                    \
        }                                                                                                              \
    }                                                                                                                  \
    void NAME##Fields::addProperties(osgDB::ObjectWrapper* wrapper)
