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
    all += message;
    return all;
}

#ifndef MESHREEL_DECODER_ALONE
namespace {

/// Made before it is needed, never changed; so short that its string is within it.
Error& no_memory()
{
    static Error error{ErrorCode::runtime, "out of memory", {}, {}, {}};
    return error;
}

} // namespace

Failure::Failure(Error error) : error_(new Error(std::move(error))) {}

Failure::Failure(const Failure& other)
    : error_(other.error_ == nullptr || other.error_ == &no_memory() ? other.error_ : new Error(*other.error_))
{
}

Failure Failure::out_of_memory() noexcept
{
    Failure failure;
    failure.error_ = &no_memory();
    return failure;
}

Failure::operator Error() &&
{
    if (error_ == &no_memory()) return *error_;
    return std::move(*error_);
}

void Failure::discard()
{
    if (error_ != &no_memory()) delete error_;
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
