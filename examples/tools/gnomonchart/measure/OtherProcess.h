// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <string>

namespace gnomon::examples {

/// How another process ended.
struct Ending {
    int status;       ///< as waitpid() has it.
    std::string said; ///< on standard output and standard error.

    /// A program that runProgram() runs has said in one sentence why it cannot do what it is asked.
    bool isRefusal() const;
};

/// Runs a command of the shell.
/// @param hears  gets each line as it comes, without its end; false closes the pipe to the command.
/// @throws std::runtime_error, one sentence, if no process can be started.
Ending runCommand(const std::string& command, const std::function<bool(const std::string& line)>& hears = {});

/// A word for the shell, whatever is in it.
std::string shellWord(const std::string& word);

/// The file of the program that runs.
std::string thisProgram();

/// What follows the last place of a word in a text, to the end of the line; empty if it is not there.
std::string after(const std::string& word, const std::string& text);

} // namespace gnomon::examples
