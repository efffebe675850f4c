// Inserted into Bullet's program that solves contacts (patch "contact solve" of kernel_patches.cpp). One sweep over one
// manifold: first the normal impulses of its points, then friction with these normal impulses.

void holdfast_push(float4* velocity, float4* spin, float inverse_mass, Matrix3x3 inverse_inertia, float4 direction,
                   float4 turn, float impulse) {
  *velocity += inverse_mass * impulse * direction;
  *spin += impulse * mtMul1(inverse_inertia, turn);
}

void holdfast_solve_contact(__global Body* bodies, __global Shape* shapes, __global Constraint4* cs) {
  int a = cs->m_bodyA;
  int b = cs->m_bodyB;
  float4 position_a = bodies[a].m_pos;
  float4 position_b = bodies[b].m_pos;
  float4 velocity_a = bodies[a].m_linVel;
  float4 velocity_b = bodies[b].m_linVel;
  float4 spin_a = bodies[a].m_angVel;
  float4 spin_b = bodies[b].m_angVel;
  float inverse_mass_a = bodies[a].m_invMass;
  float inverse_mass_b = bodies[b].m_invMass;
  Matrix3x3 inertia_a = shapes[a].m_invInertia;
  Matrix3x3 inertia_b = shapes[b].m_invInertia;
  float4 normal = mymake_float4(cs->m_linear.xyz, 0.f);
  float4 centre = mymake_float4(cs->m_center.xyz, 0.f);

  // The coefficients are -1 / effective mass of the row; impulses act on A along the direction.
  float pressure = 0.f;
  float lever = 0.f;
  for (int i = 0; i < 4; ++i) {
    if (cs->m_jacCoeffInv[i] == 0.f) continue;
    float4 point = mymake_float4(cs->m_worldPos[i].xyz, 0.f);
    float4 turn_a = cross3(point - position_a, normal);
    float4 turn_b = -cross3(point - position_b, normal);
    float speed = dot3F4(normal, velocity_a - velocity_b) + dot3F4(turn_a, spin_a) + dot3F4(turn_b, spin_b);
    float before = cs->m_appliedRambdaDt[i];
    float after = max(0.f, before + (speed + cs->m_b[i]) * cs->m_jacCoeffInv[i]);
    cs->m_appliedRambdaDt[i] = after;
    holdfast_push(&velocity_a, &spin_a, inverse_mass_a, inertia_a, normal, turn_a, after - before);
    holdfast_push(&velocity_b, &spin_b, inverse_mass_b, inertia_b, -normal, turn_b, after - before);
    pressure += after;
    lever += after * length(point - centre);
  }

  float friction = cs->m_linear.w;
  if (cs->m_fJacCoeffInv[0] != 0.f && friction > 0.f) {
    // Coulomb's law limits the force as a vector: both directions are limited together.
    float4 tangent[2];
    btPlaneSpace1(&normal, &tangent[0], &tangent[1]);
    float4 arm_a = centre - position_a;
    float4 arm_b = centre - position_b;
    float4 turn_a[2], turn_b[2];
    float after[2];
    for (int i = 0; i < 2; ++i) {
      tangent[i].w = 0.f;
      turn_a[i] = cross3(arm_a, tangent[i]);
      turn_b[i] = -cross3(arm_b, tangent[i]);
      float speed = dot3F4(tangent[i], velocity_a - velocity_b) + dot3F4(turn_a[i], spin_a) + dot3F4(turn_b[i], spin_b);
      after[i] = cs->m_fAppliedRambdaDt[i] + speed * cs->m_fJacCoeffInv[i];
    }
    float most = friction * pressure;
    float asked = sqrt(after[0] * after[0] + after[1] * after[1]);
    float share = asked > most ? most / asked : 1.f;
    for (int i = 0; i < 2; ++i) {
      float impulse = share * after[i] - cs->m_fAppliedRambdaDt[i];
      cs->m_fAppliedRambdaDt[i] = share * after[i];
      holdfast_push(&velocity_a, &spin_a, inverse_mass_a, inertia_a, tangent[i], turn_a[i], impulse);
      holdfast_push(&velocity_b, &spin_b, inverse_mass_b, inertia_b, -tangent[i], turn_b[i], impulse);
    }

    // The points around the centre resist spin about the normal, each up to the limit of its own normal impulse.
    float compliance = dot3F4(mtMul1(inertia_a, normal), normal) + dot3F4(mtMul1(inertia_b, normal), normal);
    if (compliance > 0.f) {
      float limit = friction * lever;
      float before = cs->m_center.w;
      float impulse = clamp(before - dot3F4(normal, spin_a - spin_b) / compliance, -limit, limit);
      cs->m_center.w = impulse;
      spin_a += (impulse - before) * mtMul1(inertia_a, normal);
      spin_b -= (impulse - before) * mtMul1(inertia_b, normal);
    }
  }

  if (inverse_mass_a != 0.f) {
    bodies[a].m_linVel = velocity_a;
    bodies[a].m_angVel = spin_a;
  }
  if (inverse_mass_b != 0.f) {
    bodies[b].m_linVel = velocity_b;
    bodies[b].m_angVel = spin_b;
  }
}
