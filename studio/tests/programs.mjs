// Programs of the tests.

/** A square with a hole and both arcs, on a Fanuc. */
export const SQUARE = `%
O0100 (SQUARE)
G21 G17 G90 G94 G40 G49 G80
T1 M6 (END MILL D=10.)
G54 G0 X-10. Y-10. S3000 M3
G43 H1 Z10.
G1 Z-2. F300.
Y50.
X50.
Y0.
X-10.
G0 Z10.
X20. Y20.
G1 Z-3. F200.
G2 X30. Y20. I5. J0.
G3 X40. Y20. I5. J0.
G0 Z10.
T2 M6 (DRILL D=6.)
G0 X25. Y35. S2000 M3
G43 H2 Z10.
G81 X25. Y35. Z-8. R2. F150.
G80
M5
M30
%
`;

/** Numbers that may count increments: the control's setting decides. */
export const ASKS = `%
O0101
G21 G17 G90 G94 G40 G49 G80
T1 M6
G54 G0 X0. Y0. S3000 M3
G43 H1 Z50.
G1 Z-5 F100.
X30.5
G0 Z50.
M5
M30
%
`;

/** So many short feed moves. */
export function long(moves) {
  const lines = ["%", "O0102", "G21 G17 G90 G94 G40 G49 G80", "T1 M6 (BALL D=6.)", "G54 G0 X0. Y0. S9000 M3", "G43 H1 Z10."];
  for (let at = 0; at < moves; at += 1) {
    const [angle, reach] = [at / 40, 10 + (40 * at) / moves];
    const [x, y] = [Math.cos(angle) * reach, Math.sin(angle) * reach];
    lines.push(`G1 X${x.toFixed(3)} Y${y.toFixed(3)} Z${(-1 - Math.sin(at / 900)).toFixed(3)}${at ? "" : " F2000."}`);
  }
  return [...lines, "G0 Z10.", "M5", "M30", "%", ""].join("\n");
}

/** A variable, a jump, a call and a loop. */
export const MACRO = `%
O1000 (#100)
G21 G17 G90 G94 G40 G49 G80 G54
S100 M3
G0 X0. Y0. Z0.
#100=1
N10 G1 X#100 F100.
#100=#100+1
IF[#100LE3]GOTO10
M98 P2000
M30
O2000
#1=5.
WHILE[#1LT7]DO1
G1 Y#1
#1=#1+1
END1
M99
%
`;

/** A body of triangles: a tetrahedron, as text. */
export const STL = (([a, b, c, d]) => {
  const facet = (...corners) => `facet normal 0 0 0\nouter loop\n${corners.map((corner) => `vertex ${corner.join(" ")}\n`).join("")}endloop\nendfacet\n`;
  return `solid clamp\n${facet(a, c, b)}${facet(a, b, d)}${facet(b, c, d)}${facet(c, a, d)}endsolid clamp\n`;
})([[45, -15, -20], [70, -15, -20], [45, 15, -20], [45, -15, 10]]);
