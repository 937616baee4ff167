#pragma once

namespace tbb::this_task_arena {

inline int max_concurrency() {
    return 1;
}

template <class Work>
void isolate(const Work& work) {
    work();
}

}  // namespace tbb::this_task_arena
