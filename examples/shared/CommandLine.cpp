// SPDX-License-Identifier: MIT
#include "CommandLine.h"

#include <osgDB/Registry>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iostream>
#include <sstream>
#include <stdexcept>

namespace gnomon::examples {
namespace {

[[noreturn]] void refuse(const std::string& sentence) { throw std::invalid_argument(sentence); }

bool looksLikeOption(const std::string& text) { return text.rfind("--", 0) == 0; }

std::string shortNumber(double number) {
    std::ostringstream out;
    out << number;
    return out.str();
}

std::string rangeText(double low, double high) { return shortNumber(low) + " to " + shortNumber(high); }

/// The number that `text` is; NaN if it is none.
double parse(const std::string& text) {
    double number = 0.0;
    const char* begin = text.c_str() + (text[0] == '+' ? 1 : 0);
    const char* end = text.c_str() + text.size();
    const std::from_chars_result read = std::from_chars(begin, end, number);
    return read.ec == std::errc() && read.ptr == end ? number : std::nan("");
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts(1);
    for (const char c : text) c == ',' ? parts.emplace_back() : parts.back() += c;
    return parts;
}

std::string takeArgument(osg::ArgumentParser& arguments, int position, const std::string& what) {
    const bool there = position + 1 < arguments.argc() && !looksLikeOption(arguments[position + 1]);
    if (!there) refuse(std::string(arguments[position]) + " needs a value: " + what + ".");
    const std::string value = arguments[position + 1];
    arguments.remove(position, 2);
    return value;
}

void takeValue(const Option& option, const std::string& value) {
    try {
        option.take(value);
    } catch (const std::invalid_argument& error) {
        const std::string why = error.what();
        const bool isSaid = why.find(" cannot be used. ") != std::string::npos;      // of a part of the value
        const bool isClause = std::islower(static_cast<unsigned char>(why.front())); // "the technique map has no key …"
        refuse(option.name + " " + value +
               (isSaid     ? ": "
                : isClause ? " cannot be used: "
                           : " cannot be used. ") +
               why);
    }
}

void takeOne(osg::ArgumentParser& arguments, const Option& option, int position) {
    if (!option.value.empty()) return takeValue(option, takeArgument(arguments, position, option.value));
    arguments.remove(position);
    option.take("");
}

std::vector<std::string> valuesApart(const std::vector<std::string>& words) {
    std::vector<std::string> result;
    for (const std::string& word : words) {
        const std::size_t equals = looksLikeOption(word) ? word.find('=') : std::string::npos;
        result.push_back(word.substr(0, equals));
        if (equals != std::string::npos) result.push_back(word.substr(equals + 1));
    }
    return result;
}

std::vector<char*> pointersTo(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    return pointers;
}

} // namespace

CommandWords::CommandWords(const std::vector<std::string>& given)
    : _words(valuesApart(given)),
      _pointers(pointersTo(_words)),
      _count(static_cast<int>(_words.size())),
      _arguments(&_count, _pointers.data()) {}

int runProgram(const char* name, const std::vector<std::string>& given,
               const std::function<int(osg::ArgumentParser& arguments)>& run) {
    try {
        CommandWords words(given);
        if (words.arguments().find("--version") < 0) return run(words.arguments());
        std::cout << name << " " << GNOMON_VERSION << std::endl;
        return 0;
    } catch (const std::exception& error) {
        std::cout << std::flush;
        std::cerr << name << ": " << error.what() << std::endl;
        return 1;
    }
}

void readOptions(osg::ArgumentParser& arguments, const Options& table) {
    for (const Option& option : table) {
        int times = 0;
        for (int position = arguments.find(option.name); position > 0; position = arguments.find(option.name)) {
            if (++times > 1 && !option.repeats) refuse(option.name + " is given twice. Give it once.");
            takeOne(arguments, option, position);
        }
    }
}

void refuseUnknownOptions(osg::ArgumentParser& arguments) {
    for (int i = 1; i < arguments.argc(); ++i)
        if (arguments[i][0] == '-')
            refuse(std::string("there is no option ") + arguments[i] + ". See --help for all options.");
}

/// They take the argument that follows them, whether it is there or not.
void readOsgOptions(osg::ArgumentParser& arguments) {
    for (const char* name : {"-O", "-e", "-l"})
        if (arguments.find(name) == arguments.argc() - 1) refuse(std::string(name) + " needs a value.");
    osgDB::Registry& registry = *osgDB::Registry::instance();
    for (const std::string name : {"-e", "-l"}) {
        const int at = arguments.find(name);
        const std::string given = at > 0 ? arguments[at + 1] : "";
        const std::string library = name == "-e" ? registry.createLibraryNameForExtension(given) : given;
        if (at > 0 && registry.loadLibrary(library) == osgDB::Registry::NOT_LOADED)
            refuse(name + " " + given + " cannot be used. OpenSceneGraph finds no such plugin.");
    }
    registry.readCommandLine(arguments);
}

std::string osgOptionsHelp() {
    return "  -O TEXT, -e EXT, -l LIBRARY\n      as in other OpenSceneGraph programs; OBJ files are turned from y up "
           "to z up, unless -O noRotation is given\n";
}

std::string describeOptions(const Options& table) {
    std::ostringstream out;
    for (const Option& option : table) {
        out << "  " << option.name << (option.value.empty() ? "" : " " + option.value) << "\n      " << option.says;
        if (option.repeats) out << "; may be repeated";
        if (!option.fallback.empty()) out << " (default " << option.fallback << ")";
        out << "\n";
    }
    out << "  --version\n      print the version\n";
    return out.str();
}

double readNumber(const std::string& text, double low, double high) {
    const double number = parse(text);
    if (!(number >= low && number <= high)) refuse("Allowed: a number from " + rangeText(low, high) + ".");
    return number;
}

int readWhole(const std::string& text, int low, int high) {
    const double number = parse(text);
    if (!(number >= low && number <= high) || number != std::floor(number))
        refuse("Allowed: a whole number from " + std::to_string(low) + " to " + std::to_string(high) + ".");
    return static_cast<int>(number);
}

std::vector<double> readNumbers(const std::string& text, std::size_t count, double low, double high) {
    std::vector<double> numbers;
    for (const std::string& part : split(text)) {
        const double number = parse(part);
        if (number >= low && number <= high) numbers.push_back(number);
    }
    if (numbers.size() != count || split(text).size() != count)
        refuse("Allowed: " + std::to_string(count) + " numbers from " + rangeText(low, high) +
               ", separated by commas.");
    return numbers;
}

} // namespace gnomon::examples
