// Programs to begin with, from the project's corpus, each with a sentence.

import dome from "../../../corpus/fanuc/dome.nc";
import flange from "../../../corpus/fanuc/bolt-circle-macro.nc";
import pocket from "../../../corpus/fanuc/pocket-spiral.nc";
import pecks from "../../../corpus/haas/pecks.nc";
import helix from "../../../corpus/linuxcnc/helix-bore.ngc";
import thread from "../../../corpus/linuxcnc/thread-mill.ngc";
import router from "../../../corpus/grbl/pocket.gcode";
import saddle from "../../../corpus/siemens/surface.mpf";

export interface Example {
  file: string;
  from: string;
  text: string;
  /** English, Portuguese. */
  sentence: [string, string];
}

export const EXAMPLES: Example[] = [
  {
    file: "pocket-spiral.nc",
    from: "fanuc",
    text: pocket,
    sentence: [
      "Fanuc: a rectangular pocket from the middle outwards, by a macro with two loops.",
      "Fanuc: bolsão retangular do meio para fora, por uma macro com dois laços.",
    ],
  },
  {
    file: "bolt-circle-macro.nc",
    from: "fanuc",
    text: flange,
    sentence: [
      "Fanuc: a flange with three bolt circles; one macro makes the positions, the active cycle drills.",
      "Fanuc: flange com três círculos de furos; uma macro faz as posições, o ciclo ativo fura.",
    ],
  },
  {
    file: "dome.nc",
    from: "fanuc",
    text: dome,
    sentence: [
      "Fanuc: a dome of radius 25 by a ball end mill, level by level.",
      "Fanuc: cúpula de raio 25 com fresa esférica, nível por nível.",
    ],
  },
  {
    file: "pecks.nc",
    from: "haas",
    text: pecks,
    sentence: ["Haas: deep holes with G83 and G73.", "Haas: furos profundos com G83 e G73."],
  },
  {
    file: "surface.mpf",
    from: "siemens",
    text: saddle,
    sentence: [
      "Sinumerik: a shallow saddle by a ball end mill, in rows 2 mm apart.",
      "Sinumerik: sela rasa com fresa esférica, em linhas a cada 2 mm.",
    ],
  },
  {
    file: "helix-bore.ngc",
    from: "linuxcnc",
    text: helix,
    sentence: ["LinuxCNC: a bore milled along a helix.", "LinuxCNC: furo fresado em hélice."],
  },
  {
    file: "thread-mill.ngc",
    from: "linuxcnc",
    text: thread,
    sentence: [
      "LinuxCNC: a thread M24 x 2 milled from below upwards.",
      "LinuxCNC: rosca M24 x 2 fresada de baixo para cima.",
    ],
  },
  {
    file: "pocket.gcode",
    from: "grbl",
    text: router,
    sentence: ["Grbl: a pocket on a desktop router.", "Grbl: bolsão em uma router de bancada."],
  },
];
