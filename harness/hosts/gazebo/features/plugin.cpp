// All features as one plugin of gz-physics.
#include <ignition/physics/Register.hh>

#include "hosts/gazebo/features/entities.hpp"
#include "hosts/gazebo/features/forms.hpp"
#include "hosts/gazebo/features/free_groups.hpp"
#include "hosts/gazebo/features/from_sdf.hpp"
#include "hosts/gazebo/features/joints.hpp"
#include "hosts/gazebo/features/shapes.hpp"
#include "hosts/gazebo/features/simulation.hpp"

namespace plumb::gazebo {

class Plugin : public virtual Base,
               public virtual EntityFeatures,
               public virtual SimulationFeatures,
               public virtual FreeGroupFeatures,
               public virtual JointFeatures,
               public virtual ShapeFeatures,
               public virtual FormFeatures,
               public virtual SdfFeatures {};

// One list after the other: gz-physics compares every feature of a list with all others of it when it is compiled, and
// a plugin that is added again has the features of all lists.
IGN_PHYSICS_ADD_PLUGIN(Plugin, physics::FeaturePolicy3d, EntityFeatureList)
IGN_PHYSICS_ADD_PLUGIN(Plugin, physics::FeaturePolicy3d, SimulationFeatureList)
IGN_PHYSICS_ADD_PLUGIN(Plugin, physics::FeaturePolicy3d, FreeGroupFeatureList)
IGN_PHYSICS_ADD_PLUGIN(Plugin, physics::FeaturePolicy3d, JointFeatureList)
IGN_PHYSICS_ADD_PLUGIN(Plugin, physics::FeaturePolicy3d, JointKindFeatureList)
IGN_PHYSICS_ADD_PLUGIN(Plugin, physics::FeaturePolicy3d, ShapeFeatureList)
IGN_PHYSICS_ADD_PLUGIN(Plugin, physics::FeaturePolicy3d, RoundFormFeatureList)
IGN_PHYSICS_ADD_PLUGIN(Plugin, physics::FeaturePolicy3d, OtherFormFeatureList)
IGN_PHYSICS_ADD_PLUGIN(Plugin, physics::FeaturePolicy3d, SdfFeatureList)

}  // namespace plumb::gazebo
