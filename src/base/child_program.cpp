#include "base/child_program.h"

#include <cerrno>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

extern char** environ;

namespace espalier {
namespace {

/// A process group of its own.
class SpawnAttributes {
public:
    SpawnAttributes() {
        posix_spawnattr_init(&attributes_);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
        posix_spawnattr_setpgroup(&attributes_, 0);
    }
    ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }
    SpawnAttributes(const SpawnAttributes&) = delete;
    SpawnAttributes& operator=(const SpawnAttributes&) = delete;

    const posix_spawnattr_t* get() const { return &attributes_; }

private:
    posix_spawnattr_t attributes_;
};

/// What posix_spawn does before the program begins.
class SpawnActions {
public:
    explicit SpawnActions(const ChildProgram& program) {
        posix_spawn_file_actions_init(&actions_);
        if (program.input >= 0) posix_spawn_file_actions_adddup2(&actions_, program.input, STDIN_FILENO);
        if (program.output >= 0) {
            posix_spawn_file_actions_adddup2(&actions_, program.output, STDOUT_FILENO);
            posix_spawn_file_actions_adddup2(&actions_, program.output, STDERR_FILENO);
        }
        if (!program.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions_, program.folder.c_str());
    }
    ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
    SpawnActions(const SpawnActions&) = delete;
    SpawnActions& operator=(const SpawnActions&) = delete;

    const posix_spawn_file_actions_t* get() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_;
};

int code_of(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

[[noreturn]] void fail(int error) {
    throw std::system_error(error, std::generic_category());
}

}  // namespace

int start(const ChildProgram& program) {
    std::vector<std::string> words = program.words;
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const SpawnAttributes attributes;
    const SpawnActions actions(program);
    pid_t child = 0;
    const int error = posix_spawnp(&child, arguments[0], actions.get(), attributes.get(), arguments.data(), environ);
    if (error != 0) fail(error);
    return child;
}

int wait_for(int child) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) fail(errno);
    }
    return code_of(status);
}

int poll(int child, int& code) {
    int status = 0;
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended < 0 && errno != EINTR && !(child == -1 && errno == ECHILD)) fail(errno);
    if (ended <= 0) return 0;
    code = code_of(status);
    return ended;
}

}  // namespace espalier
