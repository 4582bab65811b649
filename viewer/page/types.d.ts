// What the type checker (tests/page_types) is told beside the page's own scripts: the data in the page, and what the
// browser has that TypeScript 4.8 has not heard of. Nothing here reaches the page.

// Microseconds of engine time.
type Time = number;

// The block "report-data": what the page needs before it is ready. Made by report_data.cpp.
interface Report {
  title: string;
  story: string;
  summary: { text: string; filter: string; failed?: boolean; more?: boolean }[];
  provenance: string;
  warning: string;
  clock: { start: Time; end: Time; period: Time; frames: Time[] };
  film: { stills: any[]; width?: number; height?: number; note?: string; [more: string]: any };
  log: { [column: string]: any };
  subjects: { id: string[]; title: any; kind: any; mark: any; born: any; gone: any; outcome: any; event: any; decided: any; parent: any; block: number; [more: string]: any };
  [more: string]: any;
}

declare class DecompressionStream {
  constructor(format: "gzip" | "deflate");
  readonly readable: ReadableStream<Uint8Array>;
  readonly writable: WritableStream<Uint8Array>;
}

// The page asks the elements of its own template and of its own making; which kind each is, it knows.
interface Element {
  dataset: DOMStringMap;
  tabIndex: number;
  focus(options?: FocusOptions): void;
  blur(): void;
}
interface Event {
  readonly detail?: any;
  readonly key?: any;
}
interface EventTarget {
  closest(selectors: string): any;
}
interface Document {
  getElementById(id: string): any;
}

// The block "diff-data" of the page of a difference. Made by diff_data.cpp.
interface DiffPiece {
  id: string; title: string; state: string; target: string; copies: number; how: string; from: string; before?: string;
  sure?: number | null; positive?: number | null; total?: number | null; strong?: boolean; model_state?: string; gone?: string; curve?: [Time, number | null][];
}
interface DiffItem {
  key: string; change: string; kind: string; title: string; say: string; aspects: string[];
  rows: [role: string, status: string, left: string, right: string, variables: string[]][];
  left: DiffPiece | null; right: DiffPiece | null;
  near?: { id: string; key: string; title: string; right_is: string };
}
interface DiffSide { name: string; title: string; provenance: string; warning: string; at: string; whole: boolean; end: Time }
interface Difference {
  left: DiffSide; right: DiffSide; items: DiffItem[]; same: DiffItem[];
  runs: { settings: [string, string | null, string | null][]; files: { name: string; left: boolean; right: boolean; lines: [string, number, string][]; hidden: number }[];
    drives: [string, [number, string], [number, string]][]; parting: { common: number; left: any; right: any } | null };
}
