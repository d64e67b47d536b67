/** Whether the page may be one of `ncc serve`; a static page never is. */
declare const SERVER: boolean;

// Programs that are bundled as texts.
declare module "*.nc" {
  const text: string;
  export default text;
}
declare module "*.ngc" {
  const text: string;
  export default text;
}
declare module "*.mpf" {
  const text: string;
  export default text;
}
declare module "*.gcode" {
  const text: string;
  export default text;
}
