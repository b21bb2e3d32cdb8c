// SPDX-License-Identifier: MIT
// ThreadSanitizer does not see what oneTBB's library does. These headers stand before oneTBB's in a build under it. They tell
// it two things for each call: tasks begin after the call, and the call returns after its tasks.
#pragma once
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_for_each.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <sanitizer/tsan_interface.h>

#include <utility>

namespace tbb::told {

/// Of one call.
struct Order {
    Order() { __tsan_release(&begun); }
    void wait() { __tsan_acquire(&ended); }
    /// `body` as a task of the call.
    template <typename Body>
    auto task(const Body& body) {
        return [this, &body](auto&&... arguments) __attribute__((no_sanitize("thread"))) // reads this before the order
               ->decltype(body(std::forward<decltype(arguments)>(arguments)...)) {
            __tsan_acquire(&begun);
            struct End {
                ~End() { __tsan_release(&at); }
                char& at;
            } end{ended};
            return body(std::forward<decltype(arguments)>(arguments)...);
        };
    }

    char begun = 0, ended = 0;
};

} // namespace tbb::told
