// A value that tells who wants to know when it is another.

export class Signal<T> {
  private readonly told = new Set<(value: T) => void>();

  constructor(private value: T) {}

  get(): T {
    return this.value;
  }

  set(value: T): void {
    if (Object.is(value, this.value)) return;
    this.value = value;
    this.told.forEach((tell) => tell(value));
  }

  /** Tells the value now, and each that follows. */
  on(tell: (value: T) => void): void {
    this.told.add(tell);
    tell(this.value);
  }
}
