// SPDX-License-Identifier: MIT
// Preloaded into tests under AddressSanitizer. A block that only an unloaded library's variable points to looks like a leak, and its
// frames have no name that a suppression could give.
extern "C" __attribute__((visibility("default"))) int dlclose(void*) { return 0; }
