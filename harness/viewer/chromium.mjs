// The browser that takes pictures and runs tests: without a window, and with graphics drawn in software.
export const kBrowser = process.env.PLUMB_CHROMIUM ?? '/usr/bin/chromium';
export const kArguments = [
  '--headless',
  '--no-sandbox',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--use-gl=angle',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
  '--disable-gpu-compositing', // what is no canvas is painted without the detour by software that plays a graphics card
];
