#include "app/command.hpp"

namespace pliant {

void add_case_arguments(CLI::App& command, CaseArguments& arguments) {
  command.add_option("CASE", arguments.path, "A folder with a case.toml, or a case file")->required();
  command
      .add_option("--set", arguments.overrides,
                  "Override a key: --set fluid.viscosity=0.5, --set body.drop.center=[0,0,1]; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)  // one value each, or CASE after it would be taken as another
      ->delimiter('\0');
}

}  // namespace pliant
