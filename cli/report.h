/// What a verb has to say: figures for programs, sentences for people, an exit code for both.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "meshreel/base/result.h"

namespace meshreel::cli {

using Json = nlohmann::ordered_json;

/// The outcome of a verb that did its work, whether or not the outcome pleases.
struct Report {
    Json figures;                ///< the object that --json prints, "schema" first
    std::string text;            ///< the same for people, lines that end in '\n'
    bool text_is_result = false; ///< the text is what was asked for (standard output), not a remark (standard error)
    int exit_code = 0;           ///< other than 0: the work was done, the answer is no (3, 7)
    std::string complaint = {};  ///< the sentence that goes with such an exit code
};

/// "bad_input", as in the JSON of an error.
std::string code_name(ErrorCode code);

/// {"code", "exit", "file", "byte" or "line", "field", "message"}; what is unknown is left out.
Json error_json(const Error& error);

/// A number, or null where it is infinite or not a number: JSON has neither.
Json number(double value);

/// "1.25 MB".
std::string human_bytes(double bytes);

/// "12 345 678".
std::string human_count(unsigned long long count);

/// "1 frame", "2 frames".
std::string counted(unsigned long long count, const char* one, const char* many);

} // namespace meshreel::cli
