// A quarter of a limb under a probe: a half (y >= 0) of its section, from the probe's middle (z = 0) along the limb. Skin, muscle and bone are circles whose
// centres stand so that the tissue has one thickness in front (towards the probe, along x) and another behind. Units: mm.
girth = 530;                  // round the skin
front_fat = 10.88; front_muscle = 30.92;    // fat: with the skin, which is a membrane on its surface
back_fat = 11.03; back_muscle = 54.57;
probe = 14.66;                // radius of what presses
cells = 3;                    // over the probe's radius
depth_fat = 2; depth_muscle = 4;           // cells
half_length = 120;

R = girth / (2 * Pi);
size = probe / cells;
Rm = R - (front_fat + back_fat) / 2; xm = (back_fat - front_fat) / 2;
front = front_fat + front_muscle; back = back_fat + back_muscle;
Rb = R - (front + back) / 2; xb = (back - front) / 2;

// Cells of one size as far as the probe reaches and half as far again, then growing ones.
even = Ceil(1.5 * cells);
angle = even * size / R;
growth = 1.25;
round = Ceil(Log(1 + (Pi - angle) * R / size * (growth - 1) / growth) / Log(growth));
along = Ceil(Log(1 + (half_length - even * size) / size * (growth - 1) / growth) / Log(growth));

Point(1) = {0, 0, 0}; Point(2) = {xm, 0, 0}; Point(3) = {xb, 0, 0};
Point(10) = {R, 0, 0}; Point(11) = {R * Cos(angle), R * Sin(angle), 0}; Point(12) = {-R, 0, 0};
Point(20) = {xm + Rm, 0, 0}; Point(21) = {xm + Rm * Cos(angle), Rm * Sin(angle), 0}; Point(22) = {xm - Rm, 0, 0};
Point(30) = {xb + Rb, 0, 0}; Point(31) = {xb + Rb * Cos(angle), Rb * Sin(angle), 0}; Point(32) = {xb - Rb, 0, 0};
Circle(1) = {10, 1, 11}; Circle(2) = {11, 1, 12};
Circle(3) = {20, 2, 21}; Circle(4) = {21, 2, 22};
Circle(5) = {30, 3, 31}; Circle(6) = {31, 3, 32};
Line(10) = {20, 10}; Line(11) = {21, 11}; Line(12) = {22, 12};
Line(20) = {30, 20}; Line(21) = {31, 21}; Line(22) = {32, 22};
Transfinite Curve {1, 3, 5} = even + 1;
Transfinite Curve {2, 4, 6} = round + 1 Using Progression growth;
Transfinite Curve {10, 11, 12} = depth_fat + 1;
Transfinite Curve {20, 21, 22} = depth_muscle + 1 Using Progression 0.8;
Curve Loop(1) = {10, 1, -11, -3}; Plane Surface(1) = {1};
Curve Loop(2) = {11, 2, -12, -4}; Plane Surface(2) = {2};
Curve Loop(3) = {20, 3, -21, -5}; Plane Surface(3) = {3};
Curve Loop(4) = {21, 4, -22, -6}; Plane Surface(4) = {4};
Transfinite Surface {1, 2, 3, 4};
Recombine Surface {1, 2, 3, 4};
one[] = {}; height[] = {};
z = 0;
For k In {1 : even + along}
  z = z + (k <= even ? size : size * growth ^ (k - even));
  one[] += {1}; height[] += {z};
EndFor
For k In {0 : even + along - 1}
  height[k] = height[k] / z;
EndFor
to[] = Extrude {0, 0, z} { Surface{1, 2, 3, 4}; Layers{one[], height[]}; Recombine; };
Physical Volume("fat") = {to[1], to[7]};
Physical Volume("muscle") = {to[13], to[19]};
Physical Surface("skin") = {to[3], to[9]};
Physical Surface("bone") = {to[17], to[23]};
Physical Surface("middle") = {1, 2, 3, 4};
Physical Surface("end") = {to[0], to[6], to[12], to[18]};
Physical Surface("half") = {to[2], to[10], to[14], to[22]};
