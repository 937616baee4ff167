// Starting the program as users do.
#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace espalier::bench {

/// Runs the program without its output. A fork would copy the page tables of this program, which takes longer than a
/// small model.
inline void run_program(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), ESPALIER_PROGRAM);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t silent;
    posix_spawn_file_actions_init(&silent);
    posix_spawn_file_actions_addopen(&silent, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    const int failure = posix_spawn(&child, pointers[0], &silent, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&silent);
    int status = 0;
    if (failure != 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw std::runtime_error("the program failed: " + arguments[1]);
    }
}

}  // namespace espalier::bench
