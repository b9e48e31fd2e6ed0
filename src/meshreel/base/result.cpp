/// Errors: how they are made, kept, and become sentences.
// SPDX-License-Identifier: MIT
#include "meshreel/base/result.h"

#include "meshreel/base/text.h"

namespace meshreel {

std::string Error::sentence() const
{
    std::string all;
    if (!file.empty()) all += file + ": ";
    if (place) all += joined(place->unit == Place::Unit::byte ? "byte " : "line ", place->number, ": ");
    if (!field.empty()) all += field + ": ";
    return all + message;
}

#ifndef MESHREEL_DECODER_ALONE
Failure::Failure(Error error) : error_(new Error(std::move(error))) {}

Failure::Failure(const Failure& other) : error_(other.error_ == nullptr ? nullptr : new Error(*other.error_)) {}

void Failure::discard()
{
    delete error_;
}

Failure bad_input(std::string_view message, std::string_view field, std::optional<Place> place)
{
    return Error{ErrorCode::bad_input, std::string(message), std::string(field), {}, place};
}

Failure unsupported(std::string_view message, std::string_view field)
{
    return Error{ErrorCode::unsupported, std::string(message), std::string(field), {}, {}};
}

#endif

} // namespace meshreel
