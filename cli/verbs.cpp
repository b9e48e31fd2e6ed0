/// The table of verbs.
// SPDX-License-Identifier: MIT
#include "cli/verb.h"

#include <array>

namespace meshreel::cli {

std::unique_ptr<Verb> make_encode();
std::unique_ptr<Verb> make_decode();
std::unique_ptr<Verb> make_info();
std::unique_ptr<Verb> make_explain();
std::unique_ptr<Verb> make_validate();
std::unique_ptr<Verb> make_compare();
std::unique_ptr<Verb> make_convert();
std::unique_ptr<Verb> make_generate();
std::unique_ptr<Verb> make_picture();
std::unique_ptr<Verb> make_distort();
std::unique_ptr<Verb> make_study();
std::unique_ptr<Verb> make_play();
std::unique_ptr<Verb> make_export();

std::span<const VerbRow> verbs()
{
    static constexpr std::array rows{
        VerbRow{"encode", "compress an animation into a .reel file", make_encode},
        VerbRow{"decode", "bring an animation back from a .reel file", make_decode},
        VerbRow{"info", "take a quick look at a file", make_info},
        VerbRow{"explain", "show every field of a .reel file with its byte offset", make_explain},
        VerbRow{"validate", "check a file and say what it is and what is wrong with it", make_validate},
        VerbRow{"compare", "measure how far one animation is from another", make_compare},
        VerbRow{"convert", "turn an animation from any format into any other", make_convert},
        VerbRow{"generate", "make a sample animation", make_generate},
        VerbRow{"picture", "draw an animation, its decoded self and the error side by side", make_picture},
        VerbRow{"distort", "make an animation worse in one stated way", make_distort},
        VerbRow{"study", "correlate measures with what people saw", make_study},
        VerbRow{"play", "show animations in the browser, beside their original if it is named", make_play},
        VerbRow{"export", "make one page that plays an animation from disk", make_export},
    };
    return rows;
}

} // namespace meshreel::cli
