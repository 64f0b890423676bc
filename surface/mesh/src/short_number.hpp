// Numbers in messages.
#pragma once

#include <cstdio>
#include <string>

namespace octafield::surface {

// Three digits, whatever the size: "1.25e-07".
inline std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

}  // namespace octafield::surface
