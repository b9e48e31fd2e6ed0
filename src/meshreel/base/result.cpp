/// The one place where an error becomes a sentence.
// SPDX-License-Identifier: MIT
#include "meshreel/base/result.h"

#include "meshreel/base/text.h"

namespace meshreel {

std::string Error::sentence() const
{
    std::string all;
    if (!file.empty()) all += file + ": ";
    if (place) all += concat(place->unit == Place::Unit::byte ? "byte " : "line ", place->number, ": ");
    if (!field.empty()) all += field + ": ";
    return all + message;
}

} // namespace meshreel
