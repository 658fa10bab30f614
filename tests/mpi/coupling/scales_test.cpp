#include <gtest/gtest.h>

#include "mpi/coupling/small_cases.hpp"
#include "mpi/io/shared_folder.hpp"
#include "unit/config/case_text.hpp"

// A case whose every quantity has its unit is the same flow, whatever the scales are in which it is computed. So this
// fails if a key has the wrong dimension.
namespace pliant {
namespace {

const std::string in_si = R"case(
[box]
size = "[4, 4, 4] m"
origin = "[-2, -2, -2] m"
cells = [12, 11, 13]
stretching.z = { law = "cluster", center = "0.1 m", width = "2 m", growth = 0.05 }
[fluid]
density = "2 kg/m^3"
viscosity = "0.2 Pa s"
[forcing]
acceleration = ["0.3 m/s^2", 0, 0]
gravity = [0, 0, "-1 m/s^2"]
[initial]
flow = "perturbed"
velocity = ["0.1 m/s", 0, 0]
amplitude = "0.5 m/s"
[signals.sway]
formula = "0.2*sin(3*t)"
unit = { t = "s", v = "m" }
[signals.turn]
formula = "40*t"
unit = { t = "s" }
[signals.pump]
table = [[0, 0], [100, 80], [300, 10], [400, -90], [600, -1]]
unit = { t = "ms", v = "L/s" }
period = "0.7 s"
volume = "120 L"
balance = true
[boundary]
"z-" = { type = "wall", velocity = ["0.2 m/s", 0, 0], patches = [
  { name = "in", center = "[0.3, 0.2] m", radius = "0.8 m", flow_rate = "pump", phase = [0, 0.9] },
  { name = "leak", shape = "rectangle", center = ["-1.2 m", "-1.2 m"], size = "[1, 1] m", flow_rate = "2 L/s" } ] }
"z+" = { type = "wall", patches = [ { name = "out", shape = "outside", balance = true } ] }
[repulsion]
range = "0.15 m"
strength = "3 Pa"
[time]
end = "0.2 s"
step = "0.02 s"
[output]
history.every = 1000
[checkpoint]
keep = 0

[[body]]
name = "told"
motion = "prescribed"
surface = { shape = "sphere", frequency = 2, radius = "0.5 m" }
center = "[1.1, -1.1, -0.9] m"
path = { x = "sway", y = "3 cm", angle = "turn", pivot = "[1, -1, -1] m" }
schedule = { period = "0.1 s", phase = [0.3, 0.9] }

[[body]]
name = "thrown"
motion = "rigid"
surface = { shape = "box", size = "[0.8, 0.9, 1] m", edge = "0.25 m" }
center = "[0.9, 1.0, 1.0] m"
mass = "60 kg"
inertia = "[9, 8, 7] kg m^2"
velocity = "[1.5, 0.5, -2] m/s"
angular_velocity = ["1 rad/s", "20 rpm", 0]
coupling = "loose"

[[body]]
name = "leaflet"
motion = "hinge"
surface = { shape = "plate", size = "[0.8, 0.9] m", edge = "0.25 m" }
rotation = { axis = [0, 1, 0], angle = "90 degree" }
center = "[-1.1, 1, 0.2] m"
density = "10 kg/m^3"
thickness = "15 cm"
hinge = { point = "[-1.1, 1, 0.6] m", axis = [0, 1, 0], min_angle = "-20 degree", max_angle = "20 degree", rate = "60 degree/s", damping = "0.1 N m s", stiffness = "3 N m", rest_angle = 5, virtual_inertia = "0.2 kg m^2" }
loads = "probes"
traction.probe_length = "0.4 m"

[[body]]
name = "drop"
motion = "deformable"
coupling = "force-spreading"
surface = { shape = "sphere", frequency = 2, diameter = "1.2 m" }
center = "[-1, -1, 0.9] m"
mass_per_vertex = "0.02 kg"
damping = "0.05 kg/s"
inner_damping = "0.3 N s/m"
[body.potentials]
edge = { stiffness = "3 N/m" }
bending = { stiffness = "0.4 J", reference = "flat" }
volume = { stiffness = "40 Pa" }
pressure = { value = "5 Pa" }
area = { stiffness = "2 J/m^2" }
total_area = { stiffness = "3 N/m" }
surface_tension = { sigma = "700 mN/m", mesh_control = "0.2 N/m" }
[body.selection.top]
sphere = { center = "[0, 0, 0.6] m", radius = "0.2 m" }
[body.selection.side]
box = { lower = "[0.3, -2, -2] m", upper = "[2, 2, 2] m" }
plane = { point = "[0.1, 0, 0] m", normal = [1, 0, 0], side = "beyond" }
[body.tether.hold]
selection = "top"
stiffness = "4 N/m"
damping = "0.2 kg/s"
[body.cord.tie]
from = "side"
point = "[1, 0, 0] m"
stiffness = "5 N/m"
rest_length = "0.2 m"
[body.pull.push]
selection = "side"
force = ["0.5 N", 0, "0.5 N"]

[[body]]
name = "sheet"
motion = "deformable"
coupling = "local-mass"
surface = { shape = "plate", size = "[0.8, 0.8] m", edge = "0.2 m" }
center = "[1, 1, -1] m"
density = "30 kg/m^3"
thickness = "5 cm"
young = "2 kPa"
young_across = "1.5 kPa"
fibre = [1, 0, 0]
pinned = ["rim"]
[body.selection.rim]
border_near = "[0.4, 0, 0] m"
cylinder = { point = "[0.4, 0, 0] m", axis = [0, 1, 0], radius = "0.15 m" }

[[body]]
name = "cell"
motion = "deformable"
coupling = "loose"
surface = { shape = "sphere", frequency = 2, radius = "0.4 m" }
center = "[0, 0.1, 0.1] m"
density = "20 kg/m^3"
thickness = "0.3 m"
[body.potentials]
membrane = { law = "skalak", shear = "20 N/m", ratio = 2 }
bending = { stiffness = "0.5 N m" }
)case";

struct Outcome {
  std::vector<double> flow, positions, velocities, forces;
};

Outcome run(const std::string& units, const Communicator& ranks, const std::filesystem::path& folder) {
  const auto config = test::read_text(units + in_si);
  Simulation simulation(config, ranks, silent(folder));
  simulation.run();
  EXPECT_EQ(simulation.step(), 10);
  Outcome outcome{whole_flow(simulation.flow()), {}, {}, {}};
  const auto vertices = all_vertices(simulation.bodies());
  std::size_t at = 0;
  for (const auto& kind : simulation.bodies().kinds())
    for (auto* numbers : {&outcome.positions, &outcome.velocities, &outcome.forces}) {
      const auto begin = vertices.begin() + static_cast<std::ptrdiff_t>(at);
      const std::size_t n = 3 * kind.prototype.positions.size();
      numbers->insert(numbers->end(), begin, begin + static_cast<std::ptrdiff_t>(n));
      at += n;
    }
  for (const Vec3 f : all_vectors(simulation.bodies(), [](const Body& b) { return b.loads.balance.force; }))
    outcome.forces.insert(outcome.forces.end(), {f.x, f.y, f.z});
  return outcome;
}

void scale(std::vector<double>& values, double factor) {
  for (double& v : values) v *= factor;
}

// By powers of two, so that even round-off is the same but where a library takes roots and sums as it likes.
TEST(Scales, DoNotChangeTheFlow) {
  const SharedFolder owner;
  const Communicator world;
  const auto si =
      run("[units]\nlength = \"1 m\"\nvelocity = \"1 m/s\"\ndensity = \"1 kg/m^3\"\n", world, owner.path() / "si");
  auto own =
      run("[units]\nlength = \"0.25 m\"\ntime = \"0.0625 s\"\ndensity = \"8 kg/m^3\"\n", world, owner.path() / "own");
  const double length = 0.25, speed = 4, density = 8, force = density * speed * speed * length * length;
  const auto cells = own.flow.size() / 4;
  for (std::size_t n = 0; n < own.flow.size(); ++n) own.flow[n] *= n < 3 * cells ? speed : speed * speed;
  scale(own.positions, length);
  scale(own.velocities, speed);
  scale(own.forces, force);
  EXPECT_GT(largest(si.flow), 0.5);
  EXPECT_LT(relative_difference(own.flow, si.flow), 1e-12);
  EXPECT_LT(relative_difference(own.positions, si.positions), 1e-12);
  EXPECT_LT(relative_difference(own.velocities, si.velocities), 1e-12);
  EXPECT_LT(relative_difference(own.forces, si.forces), 1e-12);
}

// Outputs in seconds and an end in seconds need not meet to the bit in the case's own time.
TEST(Scales, LeaveNoStepOfRoundOffBeforeTheEnd) {
  const SharedFolder owner;
  auto config = small_box({6, 6, 6});
  config.time.end = 0.9;
  config.time.step = 0.1;
  config.output.fields.interval = 0.3;
  ASSERT_LT(3 * *config.output.fields.interval, config.time.end);
  Simulation simulation(config, Communicator(), silent(owner.path()));
  simulation.run();
  EXPECT_EQ(simulation.step(), 9);
  EXPECT_EQ(simulation.time(), 0.9);
}

}  // namespace
}  // namespace pliant
