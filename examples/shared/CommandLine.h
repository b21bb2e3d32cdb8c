// SPDX-License-Identifier: MIT
#pragma once
#include <osg/ArgumentParser>

#include <functional>
#include <string>
#include <vector>

namespace gnomon::examples {

/// Largest magnitude of any number on the command line: far beyond any scene, and safe to square in double.
constexpr double largestNumber = 1e12;

/// One option of a program: what --help prints and what reads it.
struct Option {
    std::string name;                                   ///< "--light"
    std::string value;                                  ///< "x,y,z,w"; empty: a flag
    std::string says;                                   ///< unit, range and meaning
    std::string fallback;                               ///< what holds without it
    std::function<void(const std::string& value)> take; ///< @throws std::invalid_argument, "allowed: …"
    bool repeats = false;
};

using Options = std::vector<Option>;

/// Words of a command line, the program's name first, for OpenSceneGraph's parser: "--size=8x6" as "--size" and "8x6".
class CommandWords {
public:
    explicit CommandWords(const std::vector<std::string>& given);
    CommandWords(const CommandWords&) = delete;
    CommandWords& operator=(const CommandWords&) = delete;

    /// What is left of them.
    osg::ArgumentParser& arguments() { return _arguments; }

private:
    std::vector<std::string> _words;
    std::vector<char*> _pointers; ///< into _words.
    int _count;
    osg::ArgumentParser _arguments; ///< of the pointers and their count.
};

/// What main() returns: what `run` returns, or 1 after one sentence on standard error if it throws. Prints the version instead
/// if that is asked for.
int runProgram(const char* name, const std::vector<std::string>& words,
               const std::function<int(osg::ArgumentParser& arguments)>& run);
inline int runProgram(const char* name, int argc, char** argv, int (*run)(osg::ArgumentParser& arguments)) {
    return runProgram(name, {argv, argv + argc}, run);
}

/// Takes the options of `table` out of `arguments`.
/// @throws std::invalid_argument, one sentence, for a value that cannot be used, is missing, or an option given twice.
void readOptions(osg::ArgumentParser& arguments, const Options& table);

/// @throws std::invalid_argument if an option is left over.
void refuseUnknownOptions(osg::ArgumentParser& arguments);

/// Takes OpenSceneGraph's own options out: -O, -e, -l. @throws std::invalid_argument if one lacks its value.
void readOsgOptions(osg::ArgumentParser& arguments);
std::string osgOptionsHelp();

/// The table as --help prints it.
std::string describeOptions(const Options& table);

/// A number of decimal digits, nothing else around it. @throws std::invalid_argument unless low <= number <= high.
double readNumber(const std::string& text, double low, double high);
int readWhole(const std::string& text, int low, int high);
/// `count` numbers with commas between them. @throws std::invalid_argument
std::vector<double> readNumbers(const std::string& text, std::size_t count, double low = -largestNumber,
                                double high = largestNumber);

} // namespace gnomon::examples
