// The parts of a step outside Bullet's pipeline, with one work-item per body: before it, the forces of the body's world
// and the inertia in its current orientation; after it, the integration of positions over the world's own step.

// Bullet's structures; body_columns.hpp has those of the host.
typedef struct {
  float4 position;
  float4 orientation;  // x, y, z, w; container_from_body
  float4 velocity;
  float4 angular_velocity;
  int shape;
  float inverse_mass;
  float world;
  float sweeps;
} Body;

typedef struct {
  float4 now[3];    // rows in the container's axes; fourth column: half extents, m
  float4 setup[3];  // the same rows, for the contact setup; fourth column: 1/step, restitution, friction
} InverseInertia;

float4 rotate(float4 q, float4 v) {
  float4 u = (float4)(q.xyz, 0.f);
  float4 t = 2.f * cross(u, v);
  return v + q.w * t + cross(u, t);
}

float4 product(float4 p, float4 q) {
  float4 u = (float4)(p.xyz, 0.f);
  float4 v = (float4)(q.xyz, 0.f);
  return (float4)((p.w * v + q.w * u + cross(u, v)).xyz, p.w * q.w - dot(u, v));
}

// Change of the body's angular velocity by the gyroscopic term over a step h, in body axes: one Newton step on the
// implicit equation (Catto, Numerical methods, GDC 2015), as in Bullet on the CPU.
float4 gyroscopic_change(float4 spin, float4 inertia, float h) {
  float4 momentum = inertia * spin;
  float4 residual = h * cross(spin, momentum);
  // Columns of J = I + h ([w] I - [I w]).
  float4 j0 = (float4)(inertia.x, h * (spin.z * inertia.x - momentum.z), h * (momentum.y - spin.y * inertia.x), 0.f);
  float4 j1 = (float4)(h * (momentum.z - spin.z * inertia.y), inertia.y, h * (spin.x * inertia.y - momentum.x), 0.f);
  float4 j2 = (float4)(h * (spin.y * inertia.z - momentum.y), h * (momentum.x - spin.x * inertia.z), inertia.z, 0.f);
  float determinant = dot(j0, cross(j1, j2));
  float4 solution = (float4)(dot(residual, cross(j1, j2)), dot(j0, cross(residual, j2)), dot(j0, cross(j1, residual)), 0.f);
  return -solution / determinant;
}

// worlds: x, y, z: effective gravity of the world, m/s²; w: its step, s, 0 for a world that is not moved.
__kernel void begin_step(__global Body* bodies, __global InverseInertia* inertias, __global const float4* body_inertia,
                         __global float4* kept, __global const float4* worlds, int count) {
  int i = get_global_id(0);
  if (i >= count) return;
  kept[2 * i] = bodies[i].velocity;
  kept[2 * i + 1] = bodies[i].angular_velocity;
  float4 world = worlds[(int)bodies[i].world];
  float h = world.w;
  inertias[i].setup[0].w = h > 0.f ? 1.f / h : 0.f;
  if (bodies[i].inverse_mass == 0.f || h == 0.f) return;

  float4 q = bodies[i].orientation;
  float4 x = rotate(q, (float4)(1.f, 0.f, 0.f, 0.f));
  float4 y = rotate(q, (float4)(0.f, 1.f, 0.f, 0.f));
  float4 z = rotate(q, (float4)(0.f, 0.f, 1.f, 0.f));
  float4 inertia = body_inertia[i];
  float4 spin = bodies[i].angular_velocity;
  float4 change = gyroscopic_change((float4)(dot(x, spin), dot(y, spin), dot(z, spin), 0.f), inertia, h);
  bodies[i].angular_velocity = spin + change.x * x + change.y * y + change.z * z;
  bodies[i].velocity += (float4)(h * world.xyz, 0.f);

  float4 row[3] = {x.x * x / inertia.x + y.x * y / inertia.y + z.x * z / inertia.z,
                   x.y * x / inertia.x + y.y * y / inertia.y + z.y * z / inertia.z,
                   x.z * x / inertia.x + y.z * y / inertia.y + z.z * z / inertia.z};
  for (int k = 0; k < 3; ++k) {
    inertias[i].now[k].xyz = row[k].xyz;
    inertias[i].setup[k].xyz = row[k].xyz;
  }
}

__kernel void end_step(__global Body* bodies, __global const float4* kept, __global const float4* worlds, int count) {
  int i = get_global_id(0);
  if (i >= count || bodies[i].inverse_mass == 0.f) return;
  float h = worlds[(int)bodies[i].world].w;
  if (h == 0.f) {
    bodies[i].velocity = kept[2 * i];
    bodies[i].angular_velocity = kept[2 * i + 1];
    return;
  }
  bodies[i].position += (float4)(h * bodies[i].velocity.xyz, 0.f);
  float4 spin = (float4)(bodies[i].angular_velocity.xyz, 0.f);
  float rate = length(spin);
  // A body rotates by at most 45° per step, as in Bullet on the CPU.
  float angle = min(rate * h, 0.785398163f);
  float4 axis = rate > 1e-6f ? spin / rate : (float4)(0.f);
  float4 turn = (float4)((sin(0.5f * angle) * axis).xyz, cos(0.5f * angle));
  bodies[i].orientation = normalize(product(turn, bodies[i].orientation));
}
