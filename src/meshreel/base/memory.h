/// Memory that cannot be had is an error like any other.
// SPDX-License-Identifier: MIT
#pragma once

#include <new>
#include <stdexcept>

#include "meshreel/base/result.h"

namespace meshreel {

/// What `body` returns; where memory runs out in it, an error of its Result, which itself needs none. All that body made is
/// given back by then.
template <class Body>
auto within_memory(const Body& body) -> decltype(body())
{
#ifdef MESHREEL_DECODER_ALONE
    return body();
#else
    try {
        return body();
    } catch (const std::bad_alloc&) {
        return Failure::out_of_memory();
    } catch (const std::length_error&) { // more than any machine has
        return Failure::out_of_memory();
    }
#endif
}

} // namespace meshreel
