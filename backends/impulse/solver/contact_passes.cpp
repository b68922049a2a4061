// The passes of all solvers over contacts, compiled once for the CPU whatever joints are beside them.
#include "solver/pass_contacts.hpp"
#include "solver/position_contacts.hpp"
#include "solver/soft_contacts.hpp"

namespace plumb::impulse {

template struct SoftContacts<true, true, true>;
template struct PositionContacts<true>;
template struct PassContacts<InSequence<true>>;
template struct PassContacts<InParts<true>>;

}  // namespace plumb::impulse
