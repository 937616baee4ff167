// Work shared between threads, as ThreadSanitizer sees it.
//
// oneTBB comes compiled without the sanitizer, which therefore does not see that a task begins after it was handed on
// and ends before the next task goes on. Shared work says so. It says nothing of two of its parts: these may run at
// once, and what one writes and another reads is a race, whichever threads ran them this time.
#pragma once

#if defined(__SANITIZE_THREAD__)
#define ESPALIER_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define ESPALIER_THREAD_SANITIZER
#endif
#endif

#ifdef ESPALIER_THREAD_SANITIZER
extern "C" {
void __tsan_acquire(void*);
void __tsan_release(void*);
}
#endif

namespace espalier {

#ifdef ESPALIER_THREAD_SANITIZER
/// From before the work is handed on until all parts have ended.
class SharedWork {
public:
    SharedWork() { __tsan_release(&begun_); }
    ~SharedWork() { __tsan_acquire(&ended_); }
    SharedWork(const SharedWork&) = delete;
    SharedWork& operator=(const SharedWork&) = delete;

    /// While one part is done.
    class Part {
    public:
        explicit Part(SharedWork& work) : work_(work) { __tsan_acquire(&work_.begun_); }
        ~Part() { __tsan_release(&work_.ended_); }
        Part(const Part&) = delete;
        Part& operator=(const Part&) = delete;

    private:
        SharedWork& work_;
    };

private:
    char begun_ = 0, ended_ = 0;
};
#else
struct SharedWork {
    struct Part {
        explicit Part(SharedWork&) {}
    };
};
#endif

}  // namespace espalier
