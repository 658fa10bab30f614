#pragma once
#include <string>

#include "config/case_document.hpp"

namespace pliant {

/// Lays one "key.path=value" over a document. The value is TOML, or a bare word taken as a string; a body goes by its
/// name: "body.drop.potentials.edge.stiffness=300". What the override replaces or excludes is removed from the
/// document. Problems are added to the document's list and name the override.
void apply_override(const std::string& text, CaseDocument& document);

}  // namespace pliant
