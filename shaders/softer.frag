// A scope's flat picture out of focus, on a coarser grid: the mean of TAPS places over a disc. ROUND:
// of those in the round field alone.
in vec2 v_at;

uniform sampler2D u_flat;
uniform float u_spread;  // the disc's radius, of the picture's side

out vec4 o_light;

void main() {
  vec4 sum = vec4(0.0);
  for (int k = 0; k < TAPS; ++k) {
    float a = 2.39996 * float(k), q = sqrt((float(k) + 0.7) / float(TAPS));
    vec2 at = v_at + u_spread * q * vec2(cos(a), sin(a));
#ifdef ROUND
    float counts = length(at - 0.5) < 0.5 ? 1.0 : 0.0;
#else
    float counts = 1.0;
#endif
    sum += counts * vec4(texture(u_flat, at).rgb, 1.0);
  }
  o_light = vec4(sum.rgb / max(sum.a, 1.0), 1.0);
}
