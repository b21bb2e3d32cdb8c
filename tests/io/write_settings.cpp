// SPDX-License-Identifier: MIT
// Writes the pages' tables of settings anew: cmake --build build --target update_settings.
#include "Pages.h"
#include "SettingsTables.h"

#include <fstream>
#include <iostream>

int main() {
    using namespace gnomon::testing;
    for (const Page& page : pages()) {
        const std::string text = withSettings(page.text);
        if (text == page.text) continue;
        std::ofstream(std::string(GNOMON_ROOT) + "/" + page.path, std::ios::binary) << text;
        std::cout << page.path << " has new tables.\n";
    }
}
